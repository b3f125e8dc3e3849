// Forces (or impulses) of all contacts at one instant, unilateral and with Coulomb's friction, in the plane and in space.
//
//     a = A F + b        F: N along the normals, T along the tangents; a: accelerations (or velocities) along the same
//
//     unilateral normal:  0 <= N complementary to a_n >= 0           given: N is known, and in b already
//     resting tangents:   |T| <= c N,  T = -c N a_t/|a_t| where a_t is not 0
//     sliding tangents:   T = p N                                    (with a given N it is in b already: leave it out)
//
// One tangent: a linear complementarity problem. With T = T+ - c N, a_t = a+ - a-, the saturations T+ = c N + T and T- = c N - T
// obey 0 <= T+ complementary to a+ >= 0 and 0 <= T- complementary to a- >= 0 (Pfeiffer, Glocker 1996; for given N the problem of
// Zhang, Wang 2017), so Lemke's method is given z = (N, T+, a-), w = (a_n, a+, T-).
//
// Two tangents: the same problem, each tangent by itself, puts a pyramid around the cone |T| <= c N; from its solution
// friction_cone.hpp goes to that of the cone.
//
// Degenerate problems end in a defined way: c N = 0 (a contact that just touches) leaves T = 0 and a_t as it is; a force
// exactly on its bound gives a_t = 0; a singular A (two feet of a rigid block) gives one of many T with the same accelerations,
// of which only sums mean something. Given normal forces: always solvable. Unilateral ones with friction may have no solution
// or several (Painleve): no_solution, or the one that Lemke's path meets first.
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "numerics/lcp.hpp"

namespace trammel::numerics {

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
};

// Fills forces F and accelerations a, in the order of A and b. On anything but `solved` both are zero.
LcpOutcome solve_contacts(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F, Vec& a);

}  // namespace trammel::numerics
