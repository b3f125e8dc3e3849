// The problem of contact_point.hpp with a polygon in place of the friction disk, as a linear complementarity problem.
//
// For each contact with friction, with directions d_k in its tangents: both signs in the plane (where the polygon is
// exact), evenly distributed in space:
//
//     T = sum_k beta_k d_k,                              z = (N, beta_1 .. beta_m, lambda)
//     0 <= N       complementary to  a_n                 >= 0
//     0 <= beta_k  complementary to  lambda + d_k . a_t  >= 0         lambda: how fast it slides
//     0 <= lambda  complementary to  c N - sum_k beta_k  >= 0
//
// (Stewart, Trinkle, Int. J. Numer. Methods Eng. 39, 2673 (1996)). Where all tangents rest the matrix is copositive,
// z.M z = F.A F + c N lambda, and Lemke's method ends in a solution unless some forces in balance, F.A F = 0, push
// contacts that still approach, b.F < 0 (Anitescu, Potra, Nonlinear Dyn. 14, 231 (1997)). Sliding contacts, T = p N,
// lose this: there may be no solution (Painleve), and Lemke's method may miss one.
//
// Among several solutions a small compliance of all contacts, a + compliance F in place of a (relative to A), selects
// one: dependent contacts then share as equal springs do, and no forces arise that only press against each other.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/programs/lcp.hpp"

namespace trammel::complementarity {

class PolyhedralCone {
 public:
  // `sides`: number of directions in space.
  PolyhedralCone(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, double compliance, int sides = 8);

  // Accelerations are in units of the largest of b, forces in units that make A's largest entry 1.
  const Mat& M() const { return M_; }
  const Vec& q() const { return q_; }
  Vec forces(const Vec& z) const { return unit_force_ * (P_ * z); }  // F

 private:
  // Indices of the variables N, beta and lambda of one contact; -1: none.
  struct Place {
    int normal = -1, first_beta = -1, betas = 0, lambda = -1;
  };
  void lay_out(const std::vector<ContactPoint>& points, int sides);

  std::vector<Place> places_;
  double unit_force_ = 1;
  Mat P_;  // F = P z
  Mat M_;
  Vec q_;
  int variables_ = 0;
};

}  // namespace trammel::complementarity
