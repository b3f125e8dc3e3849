// Contacts with friction in space: the problem of contact_forces.hpp with two tangents, |T| <= c N a cone.
//
//     Phi_n = N - max(0, N - r a_n) = 0                           0 <= N complementary to a_n >= 0
//     Phi_t = T - project(T - r a_t) = 0                          |T| <= c N,  T = -c N a_t/|a_t| where a_t is not 0
//
// project: onto the disk of radius c max(0, N - r a_n), or c N where N is given; r > 0 any numbers, here one over the
// diagonal of A. Phi is piecewise smooth; Newton's method with the derivative of the piece it is in (Alart, Curnier,
// Comput. Methods Appl. Mech. Eng. 92, 353 (1991)), shortened where it does not make |Phi| smaller, ends at round-off
// in a few steps from the pyramid's solution. The step is the least one where A is singular (dependent feet). Where it
// stalls, sweeps over the contacts, each projected for itself with the others' forces as they are (Gauss, Seidel), go
// on: with given normal forces these converge from anywhere, to the least of T.A T/2 + b.T on the disks.
#pragma once

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

// F: where to begin, and the solution. False: it found none in as many rounds of Newton's method and 200 sweeps.
[[nodiscard]] bool solve_cones(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F,
                               int rounds = 40);

}  // namespace trammel::complementarity
