// All modes of a few contacts: open, sticking, sliding one way or the other, by branch and bound. Complete: it finds forces that
// obey contact_point.hpp wherever there are some, in the plane and of contacts that slide; "none" is a proof.
//
// A contact without a mode yet is relaxed: all of its variables in polyhedral_cone.hpp are >= 0, whether they are complementary or
// not. What is left is a system of linear equations and inequalities, which a non-negative least squares problem solves or
// shows to have no solution; then no completion of these modes has one, and none is looked at.
#pragma once

#include <functional>
#include <vector>

#include "complementarity/contact_point.hpp"
#include "complementarity/lcp.hpp"

namespace trammel::complementarity {

// `accept(F)` judges what is found; the search goes on where it says no. no_solution: proved, as nothing comes nearer than 1e-8 of
// the size of b. gave_up: after `most_nodes`, or where something came so near and was not accepted.
LcpOutcome search_modes(const std::vector<ContactPoint>& points, const Mat& A, const Vec& b, int most_nodes,
                        const std::function<bool(const Vec&)>& accept);

}  // namespace trammel::complementarity
