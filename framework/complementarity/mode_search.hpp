// All modes of a few contacts: open, sticking, sliding, by branch and bound. Complete: it finds forces that obey
// contact_point.hpp wherever there are some, and "none" is a proof, of forces up to a bound: those that accelerate,
// each alone and all of these added, by less than 1e4 times b. Larger ones, which balance each other, are within what
// round-off of A may hide (mode_relaxation.hpp).
//
// A contact without a mode yet is relaxed (mode_relaxation.hpp). Where what is left has no forces, no completion of
// these modes has, and none is looked at. In space the directions that a contact slides in are quarters of the circle
// first, then halves of those, down to a degree; the round cone's own Newton method goes on from what is found there.
#pragma once

#include <functional>
#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/programs/lcp.hpp"

namespace trammel::complementarity {

// `accept(F)` judges what is found; the search goes on where it says no. no_solution: proved up to that bound, as
// nothing comes nearer than 1e-8 of the size of b. gave_up: after `most_nodes`, or where something came so near and was
// not accepted.
LcpOutcome search_modes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
                        const std::function<bool(const Vec&)>& accept);

}  // namespace trammel::complementarity
