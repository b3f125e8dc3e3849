// Forces of contacts of which some modes are decided and others are not: linear equations and inequalities that every
// solution of contact_point.hpp in these modes satisfies.
//
//     undecided   N >= 0, a_n >= 0, T in the cone
//     open        N = T = 0, a_n >= 0
//     sticking    a_n = 0, a_t = 0, T in the cone
//     sliding     a_n = 0, T on the cone's side and a_t against it, both in directions between two angles
//
// In the plane a direction is one of two, and the cone has two edges: nothing is lost. In space the disk becomes the
// octagon around it, and the arc between two angles the triangle around it, so that what has no solution here has none
// there. All unknowns x are >= 0, along edges of cones; a non-negative least squares problem B x = d finds them or
// shows that there are none: what it misses is a vector r with r . d > 0 and r . B_j <= 0 (Farkas). Of columns whose
// r . B_j is round-off only that much follows: sum_j x_j |B_j| > 1e4, forces that by themselves accelerate 1e4 times as
// much as b, and balance each other.
#pragma once

#include <vector>

#include "complementarity/programs/contact_point.hpp"

namespace trammel::complementarity {

struct DecidedMode {
  enum class Kind {
    undecided,
    open,
    pressing,
    sticking,
    sliding
  };  // pressing: without friction, or as it slides already
  Kind kind = Kind::undecided;
  double from = 0, to = 0;  // [rad] directions of T, if sliding
};

struct RelaxedForces {
  enum class Verdict { found, none, doubtful };  // none: proved but for such forces
  Verdict verdict = Verdict::none;
  Vec F, a;
};
RelaxedForces relaxed_forces(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b,
                             const std::vector<DecidedMode>& modes);

}  // namespace trammel::complementarity
