// M = C C^T for a sparse symmetric positive definite matrix, and the triangular solves with C.
//
// C = P^T L with P M P^T = L L^T, P of approximate minimum degree. The order is found once for a pattern.
#pragma once

#include <Eigen/SparseCholesky>

#include <trammel/types.hpp>

namespace trammel::numerics {

class SparseCholesky {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  // Reads the lower triangle. False: not positive definite, or not finite.
  [[nodiscard]] bool compute(const Sparse& M);

  void solve_lower(Vec& x);          // x := C^-1 x
  void solve_lower_of_rows(Mat& X);  // X := X C^-T
  void solve_transposed(Vec& x);     // x := C^-T x
  void solve(Vec& x);                // x := M^-1 x

 private:
  Eigen::SimplicialLLT<Sparse> factors_;
  Vec scratch_;
  Mat columns_;
};

}  // namespace trammel::numerics
