// M = L L^T of a symmetric positive definite matrix, dense, and the triangular solves with L.
//
// Plain loops by columns: for a few dozen unknowns Eigen's decomposition costs three times as much (it works by rows and
// also keeps a norm). Larger matrices are left to Eigen's blocked algorithm, which wins by its use of the cache.
#pragma once

#include <trammel/types.hpp>

namespace trammel::numerics {

class Cholesky {
 public:
  // Reads the lower triangle. False: not positive definite, or not finite.
  [[nodiscard]] bool compute(const Mat& M);
  const Mat& factor() const { return L_; }  // its lower triangle is L

  void solve_lower(Eigen::Ref<Vec> x) const;       // x := L^-1 x
  void solve_lower(Mat& X) const;                  // by columns
  void solve_transposed(Eigen::Ref<Vec> x) const;  // x := L^-T x
  void solve(Eigen::Ref<Vec> x) const;             // x := M^-1 x

 private:
  Mat L_;
};

}  // namespace trammel::numerics
