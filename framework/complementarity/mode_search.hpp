// Searches all modes of a few contacts (open, sticking, sliding) by branch and bound. Complete: it finds forces that
// obey contact_point.hpp if there are any, and otherwise proves that there are none up to a bound: forces that
// accelerate, each alone and all added, by less than 1e4 times b. Larger forces that balance each other are within the
// round-off of A (mode_relaxation.hpp).
//
// A contact without a mode yet is relaxed (mode_relaxation.hpp). If the relaxation has no forces, no completion of
// these modes has any, and none is examined. In space the directions of a sliding contact are first quarters of the
// circle, then halves of those, down to a degree; Newton's method on the round cone continues from the result.
#pragma once

#include <functional>
#include <vector>

#include "complementarity/programs/contact_point.hpp"
#include "complementarity/programs/lcp.hpp"

namespace trammel::complementarity {

// `accept(F)` judges a solution; the search continues if it returns false. no_solution: proved up to that bound, since
// nothing comes nearer than 1e-8 of b. gave_up: after `most_nodes`, or if something came so near and was not accepted;
// after the 50th of these at once, since each costs as much as ten other sets of modes.
LcpOutcome search_modes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
                        const std::function<bool(const Vec&)>& accept);

}  // namespace trammel::complementarity
