// S = G M^-1 G^T + eps 1 of many bodies, the Schur complement of the rows, and its factors L D L^T.
//
// A sum over bodies, each giving a block on the rows that touch it. It is never formed as a whole: bodies' shares go right to the
// fronts (complement_layout.hpp) that eliminate their rows (F) and leave a matrix on their boundary (B) to the front above:
//
//     [S_FF S_BF^T]  =  [L_FF  ] [D  ] [L_FF^T L_BF^T]         U = D [L_FF^T L_BF^T]
//     [S_BF S_BB  ]     [L_BF 1] [  R] [            1]
//
// Of a chain of 100 links with five rows each this takes 1/3 of the time of Eigen's simplicial factors.
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "numerics/body_block.hpp"
#include "numerics/cholesky.hpp"
#include "numerics/complement_layout.hpp"

namespace trammel::numerics {

class RowComplement {
 public:
  // Of the first nc rows. masses: of each body.
  void factorise(const std::vector<BodyBlock>& bodies, const std::vector<Cholesky>& masses, int nc, double eps);
  // Each pivot is more than the square of `least_sine` beside its diagonal: its row's angle to those eliminated before.
  bool is_safe(double least_sine) const;
  // No less than the least eigenvalue of S with its diagonal scaled to 1, by a step of inverse iteration.
  double softest();
  double largest() const { return diagonal_.maxCoeff(); }
  double largest_share(const Vec& y) const {
    return diagonal_.cwiseProduct(y).lpNorm<Eigen::Infinity>();
  }                                  // |S_ii y_i|
  void solve(const Vec& r, Vec& y);  // y = S^-1 r, not in place

 private:
  using Front = ComplementLayout::Front;
  void resize(int nc);
  void assemble(const std::vector<BodyBlock>& bodies, const std::vector<Cholesky>& masses, const Front& front,
                double eps);
  void form_Y(const BodyBlock& body, const Cholesky& mass, const std::vector<int>& order, Mat& Y);
  void add_share(int body, const Front& front);
  void take(const Front& child, const std::vector<int>& places, const Front& front);
  void eliminate(const Front& front);
  void solve_lower(const Front& front, Vec& y);
  void solve_upper(const Front& front, Vec& y);

  ComplementLayout layout_;
  Vec L_, U_;                               // of all fronts; L's columns of the boundary hold R
  Vec diagonal_, pivots_, inverse_pivots_;  // by rows
  Vec work_, scale_, start_, end_;
  std::vector<Mat>
      Y_;      // G C^-T of each body, M = C C^T: the first rows of the order of elimination, and padded ones of zeros
  Vec share_;  // Y Y^T of one
};

}  // namespace trammel::numerics
