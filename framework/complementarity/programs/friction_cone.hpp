// Contacts with friction in space: the problem of contact_forces.hpp with two tangents, |T| <= c N a cone.
//
//     Phi_n = N - max(0, N - r a_n) = 0                           0 <= N complementary to a_n >= 0
//     Phi_t = T - project(T - r a_t) = 0                          |T| <= c N,  T = -c N a_t/|a_t| where a_t is not 0
//
// `project` maps onto the disk of radius c max(0, N - r a_n), or c N where N is given; r > 0 is arbitrary, here one
// over the diagonal of A. Phi is piecewise smooth. Newton's method takes the derivative of the present piece (Alart,
// Curnier, Comput. Methods Appl. Mech. Eng. 92, 353 (1991)) and shortens steps that do not reduce |Phi|; from the
// pyramid's solution it reaches round-off in a few steps. If A is singular (dependent feet), the least step is taken.
// If it stalls, sweeps over the contacts continue, which project each contact with the present forces of the others
// (Gauss, Seidel). With given normal forces these converge from any start to the minimum of T.A T/2 + b.T on the disks.
#pragma once

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

// F: start and solution. False: none was found in `rounds` of Newton's method and 200 sweeps.
[[nodiscard]] bool solve_cones(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F,
                               int rounds = 40);

// The same by up to 25,600 sweeps that Newton's method does not interrupt: where |Phi| has a minimum that is no
// solution, each of its attempts would lead back to it. Slow, but sweeps pass such minima.
[[nodiscard]] bool sweep_cones(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, Vec& F);

}  // namespace trammel::complementarity
