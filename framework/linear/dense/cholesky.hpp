// M = C C^T of a symmetric positive definite matrix, dense, and the triangular solves with C.
//
// C = L D^1/2 with M = L D L^T, which keeps square roots out of the loop over columns. Plain loops by columns
// (simd_columns.hpp) are several times faster than Eigen's decomposition for a few dozen unknowns. Larger matrices are
// left to Eigen's blocked algorithm, which uses the cache better.
//
// In each row the factors keep the zeros before M's first entry, and loops skip them: bodies one after the other are
// blocks.
#pragma once

#include <vector>

#include <trammel/decompositions.hpp>
#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

bool is_diagonal(const Mat& M);  // of a symmetric one, by its lower triangle

class Cholesky {
 public:
  // Reads the lower triangle. False: not positive definite, or not finite.
  [[nodiscard]] bool compute(const Mat& M);
  double pivot(Eigen::Index j) const { return in_blocks() ? blocks_.matrixLLT()(j, j) : root_[j]; }  // C_jj

  void solve_lower(Eigen::Ref<Vec> x);                // x := C^-1 x
  void solve_lower_of_rows(Eigen::Ref<Mat> X) const;  // X := X C^-T
  void solve_transposed(Eigen::Ref<Vec> x);           // x := C^-T x
  void solve(Eigen::Ref<Vec> x);                      // x := M^-1 x

 private:
  bool in_blocks() const { return n_ == 0 && !diagonal_; }
  bool unrolled() const { return L_.rows() == most_unrolled; }
  bool invert_diagonal(const Mat& M);
  void resize(Eigen::Index n);
  void find_zeros(const Mat& M);
  bool factorise_by_columns();
  bool factorise_unrolled();

  Eigen::Index n_ = 0;
  bool diagonal_ = false;  // M is diagonal, as for rigid bodies in the coordinates of their centres
  Mat L_, U_;              // L and D L^T, of few unknowns L D; columns padded; on their other sides anything
  Vec inverse_, root_, inverse_root_;  // of D
  // Row i of L is 0 before column first_[i], and so column j from row end_[j] on.
  std::vector<Eigen::Index> first_, end_, first_before_;
  Vec rest_;  // scratch
  Eigen::LLT<Mat> blocks_;
};

}  // namespace trammel::numerics
