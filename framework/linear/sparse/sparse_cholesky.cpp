#include "linear/sparse/sparse_cholesky.hpp"

namespace trammel::numerics {

bool SparseCholesky::compute(const Sparse& M) {
  factors_.compute(M);
  return factors_.info() == Eigen::Success && factors_.matrixL().nestedExpression().coeffs().allFinite();
}

void SparseCholesky::solve_lower(Vec& x) {
  scratch_ = factors_.permutationP() * x;
  factors_.matrixL().solveInPlace(scratch_);
  x = scratch_;
}

void SparseCholesky::solve_lower_of_rows(Mat& X) {
  columns_ = factors_.permutationP() * X.transpose();
  factors_.matrixL().solveInPlace(columns_);
  X = columns_.transpose();
}

void SparseCholesky::solve_transposed(Vec& x) {
  factors_.matrixU().solveInPlace(x);
  scratch_ = factors_.permutationPinv() * x;
  x = scratch_;
}

void SparseCholesky::solve(Vec& x) {
  solve_lower(x);
  solve_transposed(x);
}

}  // namespace trammel::numerics
