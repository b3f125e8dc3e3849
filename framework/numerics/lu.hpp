// P A = L U by Gaussian elimination with row pivoting, dense, and the solves with it.
//
// Plain loops by columns: up to 20 unknowns Eigen's blocked algorithm takes twice as long for the factors, at 47 1.4 times, and
// 1.2 to 2 times as long for a solve. An HHT step of the beam takes 2.33 instead of 2.70 us (7 unknowns), 12.0 instead of 13.7 us
// (19). Larger matrices are left to Eigen.
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
