// The linear complementarity problem, by Lemke's method.
//
//     w = M z + q,   w >= 0,   z >= 0,   w . z = 0
//
// In contact mechanics M (n x n) is the Delassus matrix, z the impulses or normal forces, w the rates of opening.
// Lemke's complementary pivoting with covering vector 1 (Cottle, Pang, Stone 1992, algorithm 4.4.5). The ratio test
// uses q plus a small irregular vector, which makes every pivot unique, so that degenerate problems (dependent
// contacts, q with zeros) cannot cycle; the solution is that of q itself. It finds a solution, if there is one, for
// every copositive-plus M: all positive semi-definite ones, so every frictionless impact. P-matrices have exactly one
// solution.
#pragma once

#include <trammel/types.hpp>

namespace trammel::complementarity {

enum class LcpOutcome {
  solved,
  no_solution,  // ended in a ray: for a copositive-plus M the problem is infeasible
  gave_up,      // too many pivots, or numbers that are not finite
};

// Fills z and w (n). On anything but `solved` both are zero.
LcpOutcome solve_lcp(const Mat& M, const Vec& q, Vec& z, Vec& w);

}  // namespace trammel::complementarity
