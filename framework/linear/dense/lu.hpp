// P A = L U by Gaussian elimination with row pivoting, dense, and the solves with it.
//
// Plain loops by columns (simd_columns.hpp) are faster than Eigen's blocked algorithm for a few dozen unknowns
// (tools/bench/README.md). Larger matrices are left to Eigen.
#pragma once

#include <vector>

#include <trammel/decompositions.hpp>
#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

class Lu {
 public:
  void compute(const Mat& A);  // square; a singular one gives a pivot that is 0 or round-off
  double pivot(Eigen::Index j) const { return in_blocks() ? blocks_.matrixLU()(j, j) : LU_(j, j); }
  // Whether a pivot of A from column `first` on is at most `least` times the largest entry of its own column, so that
  // different scales of columns make none small; also if it is not a number.
  bool has_small_pivot(const Mat& A, double least, Eigen::Index first = 0) const;
  bool is_small_pivot(const Mat& A, double least, Eigen::Index j) const;
  void solve(const Vec& b, Vec& x);        // not in place
  std::vector<Eigen::Index> rows() const;  // A's, in the order of those of L U

 private:
  bool in_blocks() const { return n_ == 0; }
  bool unrolled() const { return !in_blocks() && padded(n_) == most_unrolled; }
  void eliminate();

  Eigen::Index n_ = 0;
  Mat LU_;                          // columns padded
  std::vector<Eigen::Index> rows_;  // LU_'s row i is A's row rows_[i]
  Vec inverse_pivots_, rest_, y_;
  Eigen::PartialPivLU<Mat> blocks_;
};

}  // namespace trammel::numerics
