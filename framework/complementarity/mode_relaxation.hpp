// Forces of contacts of which some modes are decided and others are not: linear equations and inequalities that every
// solution of contact_point.hpp in these modes satisfies.
//
//     undecided   N >= 0, a_n >= 0, T in the cone
//     open        N = T = 0, a_n >= 0
//     sticking    a_n = 0, a_t = 0, T in the cone
//     sliding     a_n = 0, T on the cone's side and a_t against it, both in directions between two angles
//
// In the plane there are two directions and the cone has two edges: the relaxation is exact. In space the disk becomes
// the octagon around it, and the arc between two angles the triangle around it; if the relaxation has no solution, the
// problem has none. All unknowns x are >= 0, along edges of cones. A non-negative least squares problem B x = d finds
// them or shows that there are none: its residual is a vector r with r . d > 0 and r . B_j <= 0 (Farkas). For columns
// whose r . B_j is only round-off the proof is limited to sum_j x_j |B_j| <= 1e4: it does not exclude forces that would
// each accelerate 1e4 times as much as b and balance each other.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

struct DecidedMode {
  enum class Kind { undecided, open, pressing, sticking, sliding };  // pressing: without friction, or with a known slip
  Kind kind = Kind::undecided;
  double from = 0, to = 0;  // [rad] directions of T, if sliding
};

struct RelaxedForces {
  enum class Verdict { found, none, doubtful };  // none: proved, up to the bound above
  Verdict verdict = Verdict::none;
  Vec F, a;
};
RelaxedForces relaxed_forces(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b,
                             const std::vector<DecidedMode>& modes);

}  // namespace trammel::complementarity
