// Which rows of a sparse matrix depend on the rows before them.
//
// Row after row is rotated into a triangle R, whose columns are in an order that leaves few entries (George, Heath, Linear Algebra Appl.
// 34 (1980), 69; by dissection each row meets few others on its way, also in long chains). Nothing is left of a row that depends on
// those before it. Rotations do not square the condition number: what a long mast's rows tell by 1e-8 of their length is seen.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace trammel::numerics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// Ascending. `tolerance`: of what is left of a row, beside its length, that counts as nothing.
std::vector<int> dependent_rows(const SparseRows& G, double tolerance);

}  // namespace trammel::numerics
