// S = G M^-1 G^T of many bodies, the Schur complement of the rows, and its factors L D L^T.
//
// S is a sum over bodies of one block on the rows that touch the body. It is never formed as a whole: the blocks are
// added directly to the fronts (complement_layout.hpp) that eliminate their rows (F) and leave an update matrix on
// their boundary (B) to the front above:
//
//     [S_FF S_BF^T]  =  [L_FF  ] [D  ] [L_FF^T L_BF^T]
//     [S_BF S_BB  ]     [L_BF 1] [  R] [            1]
//
// Timings beside Eigen's simplicial factors: tools/bench/README.md.
#pragma once

#include <span>
#include <vector>

#include <trammel/types.hpp>

#include "linear/bodies/body_block.hpp"
#include "linear/bodies/body_masses.hpp"
#include "linear/complement/complement_layout.hpp"

namespace trammel::numerics {

class RowComplement {
 public:
  // For the first nc rows. False: a pivot, relative to its diagonal entry, is at most the square of `least_sine`; it is
  // the square of the sine of the row's angle to the rows eliminated before. The factors are then incomplete.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies, const BodyMasses& masses, int nc,
                               double least_sine = 0);
  // For y = S^-1 r: a mean of the eigenvalues of S with its diagonal scaled to 1 (a Rayleigh quotient), so no less than
  // the smallest one, and close to it if r has a component in its direction, which inverse iteration amplifies.
  double softness(const Vec& r, const Vec& y) const { return r.dot(y) / y.cwiseAbs2().dot(diagonal_); }
  // max |S_ii y_i|
  double largest_share(const Vec& y) const { return diagonal_.cwiseProduct(y).lpNorm<Eigen::Infinity>(); }
  void solve(const Vec& r, Vec& y);  // y = S^-1 r, not in place

 private:
  using Front = ComplementLayout::Front;
  using Share = ComplementLayout::Share;
  void resize(int nc);
  void assemble(const std::vector<BodyBlock>& bodies, const BodyMasses& masses, const Front& front);
  Eigen::Map<Mat> form_Y(const std::vector<BodyBlock>& bodies, const BodyMasses& masses, const Share& share);
  void add_at(std::span<const int> places, const double* A, Eigen::Index stride, const Front& front);
  void eliminate(const Front& front);
  double* column(const Front& front, Eigen::Index j);  // of L or R
  void solve_lower(const Front& front, Vec& y);
  void solve_upper(const Front& front, Vec& y);
  void solve_upper_of_large_front(const Front& front, Vec& y);

  ComplementLayout layout_;
  Vec L_, R_;     // of all fronts; the diagonal of L, which is 1, stores D^-1
  Vec diagonal_;  // of S
  double least_square_sine_ = 0;
  Vec work_;
  // Of one body, in the order of elimination: Y = G C^-T with M = C C^T, with padding rows of zeros, and Y Y^T.
  Vec Y_, product_;
};

}  // namespace trammel::numerics
