// Which rows of a sparse matrix depend on the rows before them.
//
// Row after row is rotated into a triangle R, whose columns are in an order that leaves few entries (George, Heath,
// Linear Algebra Appl. 34 (1980), 69; by dissection each row meets few others on its way, also in long chains). R grows
// less by a row the more it depends on those before it. Rotations do not square the condition number: of masts and
// hoops of thousands of units, whose own rows are dependent but for 1e-8, those that are redundant are told exactly.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace trammel::numerics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// Ascending. `tolerance`: sine of a row's angle to those before it, from which on it counts.
std::vector<int> dependent_rows(const SparseRows& G, double tolerance);

}  // namespace trammel::numerics
