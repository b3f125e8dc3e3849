// Finds the rows of a sparse matrix that depend on the rows before them.
//
// Row after row is rotated into a triangle R. The order of its columns keeps it sparse (George, Heath, Linear Algebra
// Appl. 34 (1980), 69; with nested dissection each row meets few others, also in long chains). A row enlarges R the
// less, the more it depends on the rows before. Rotations do not square the condition number: in masts and hoops of
// thousands of units, whose independent rows are dependent up to 1e-8, exactly the redundant rows are found.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace trammel::numerics {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

// Indices, ascending. `tolerance`: a row counts as independent if the sine of its angle to those before exceeds it.
std::vector<int> dependent_rows(const SparseRows& G, double tolerance);

}  // namespace trammel::numerics
