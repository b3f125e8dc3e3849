// P A = L U by Gaussian elimination with row pivoting, dense, and the solves with it.
//
// Plain loops by columns: for a few dozen unknowns Eigen's blocked algorithm costs twice as much for the factors and three times
// for a solve. Larger matrices are left to it.
#pragma once

#include <vector>

#include <Eigen/LU>

#include <trammel/types.hpp>

namespace trammel::numerics {

class Lu {
 public:
  void compute(const Mat& A);  // square; a singular one gives a pivot that is 0 or round-off
  double pivot(Eigen::Index j) const { return factors()(j, j); }
  void solve(const Vec& b, Vec& x) const;  // not in place

 private:
  bool in_blocks() const { return rows_.empty(); }
  const Mat& factors() const { return in_blocks() ? blocks_.matrixLU() : LU_; }
  void eliminate();

  Mat LU_;
  std::vector<Eigen::Index> rows_;  // LU_'s row i is A's row rows_[i]
  Eigen::PartialPivLU<Mat> blocks_;
};

}  // namespace trammel::numerics
