// Multipliers of redundant rows: of all y with the same forces G^T y the one of least norm, sum_i y_i^2, with rows in
// the units in which they are given.
//
//     y := y + n,   n in the null space of G^T,   y + n perpendicular to it
//
// The rows are eliminated front by front as in frontal_kkt.hpp, but unknowns are not merged, since the multipliers of
// merging rows count too. In a front, w are the multipliers of its own rows, of length one, and of the rows passed on
// by its children:
//
//     w = Q_2 p + Q_3 z,   y_own = D w_own     p: multipliers of the rows that it passes to its parent; D: 1/length
//     B [Q_3 Q_2] = Q [R_33 R_32; 0 R]               B: D of own rows, R of each child's
//     |y + n|^2 of all rows up to here = |R p + beta_2|^2 + const   for   R_33 z = -(beta_3 + R_32 p)
//
// beta = Q^T (y_own, beta_2 of the children). The forward sweep finds beta, the backward sweep p and z. All operations
// are orthogonal or divisions by a triangle of one front, so nothing is squared, and the work grows with the number of
// rows.
#pragma once

#include <vector>

#include "linear/bodies/body_block.hpp"
#include "linear/fronts/front_layout.hpp"

namespace trammel::numerics {

class LeastMultipliers {
 public:
  // For the first nc rows. `rank_tolerance` as in kkt.hpp: rows that are dependent up to it count as redundant.
  void factorise(const std::vector<BodyBlock>& bodies, int nc, double rank_tolerance);
  void minimise(Vec& y) const;
  int dependent() const { return dependent_; }  // number of dependent rows

 private:
  struct Eliminated {
    Vec scale;         // D
    Mat null, passed;  // Q_3: m x dependent; Q_2: m x passed
    Mat Q, R_33, R_32, R;
  };
  void lay_out(const std::vector<BodyBlock>& bodies, int nc);
  int rows_of(const FrontLayout::Front& front) const;
  bool eliminate(const std::vector<BodyBlock>& bodies, double rank_tolerance);
  bool sum_rows(std::size_t k, const std::vector<BodyBlock>& bodies, int m, Vec& C);
  void compose(std::size_t k);

  FrontLayout layout_;
  std::vector<Eliminated> fronts_;
  std::vector<Mat> up_;  // by front: rows passed on, of length one, on its boundary; empty once the parent has them
  int dependent_ = 0;
};

}  // namespace trammel::numerics
