// Contacts at one instant, unilateral and with Coulomb's friction, in the plane and in space: what their forces must
// satisfy.
//
//     a = A F + b        F: N along the normals, T along the tangents [N]; a: accelerations along the same [m/s^2]
//
//     unilateral normal:  0 <= N complementary to a_n >= 0           given: N is known, and in b already
//     resting tangents:   |T| <= c N,  T = -c N a_t/|a_t| where a_t is not 0
//     sliding tangents:   T = p N                                    (with a given N it is part of b)
//
// A is the Delassus matrix: symmetric, positive semi-definite, singular where contacts are dependent. In an impact F
// are impulses [N s] and a velocities [m/s].
#pragma once

#include <vector>

#include <trammel/types.hpp>

namespace trammel::complementarity {

struct ContactPoint {
  enum class Tangent { none, resting, sliding };
  int normal = -1;   // its index in A and b; -1: the normal force is given
  int tangent = -1;  // of the first, likewise; -1: frictionless, or sliding under a given force
  int tangents = 1;  // of which the second follows the first
  Tangent kind = Tangent::none;
  double coefficient = 0;                           // c >= 0 of resting tangents
  Eigen::Vector2d ratio = Eigen::Vector2d::Zero();  // p of sliding ones
  double given = 0;                                 // N, if given

  // A bound of 0 is no friction, whatever the acceleration.
  bool held() const { return kind == Tangent::resting && coefficient > 0 && (normal >= 0 || given > 0); }
  bool slides() const { return kind == Tangent::sliding && normal >= 0 && tangent >= 0; }
};

// The largest violation of these conditions by F: for normals the natural map |min(A_nn N, a_n)|; for tangents |T -
// Pi(T - a_t / A_tt)| A_tt, where Pi projects onto the disk |T| <= c N. Relative to b and to 1e-4 of the terms of A F,
// which carry its round-off. `nothing`: a violation of this size counts as 1e-9, however small b is.
double violation(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& F, double nothing = 0);
// The same for accelerations `a` in which those along implied rows were corrected.
double violation(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, const Vec& F, const Vec& a,
                 double nothing);
// A solution violates the conditions by no more.
constexpr double largest_violation = 1e-9;

}  // namespace trammel::complementarity
