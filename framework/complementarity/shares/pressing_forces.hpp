// Normal forces without friction: the convex quadratic program
//
//     minimise  N.A N / 2 + b.N,   N >= 0,        whose conditions are   0 <= N complementary to a = A N + b >= 0
//
// A is symmetric positive semi-definite, of any rank. Principal pivoting (Dantzig, Cottle; Cottle, Pang, Stone, The
// Linear Complementarity Problem, 1992, section 4.2): one force after the other is raised until its contact no longer
// approaches; a force that falls to 0 meanwhile leaves the set. Only independent contacts carry, so N is not unique
// where contacts are dependent; a is unique.
//
// There is no solution exactly if the program is unbounded: some forces in balance with each other, d >= 0 with A d =
// 0, push contacts that still approach, b.d < 0. Such a d is a proof: gaps must close between bodies that cannot give
// way.
#pragma once

#include <trammel/types.hpp>

#include "complementarity/programs/lcp.hpp"

namespace trammel::complementarity {

// Fills N; for no_solution with that d, of length 1.
LcpOutcome pressing_forces(const Mat& A, const Vec& b, Vec& N);

}  // namespace trammel::complementarity
