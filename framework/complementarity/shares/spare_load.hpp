// How much further contacts could be unloaded before they cannot carry their resultants: the cone program
//
//     maximise s,     E F = lambda,     |T| <= c (N - s)  at each contact
//
// Negative if no admissible forces have these resultants; a continuous function of them. Bounded by `most_spare_load`
// times their size, because s is unbounded for contacts that press against each other. Solved by cone_program.hpp. If
// s < 0, the forces F of the solution are those that leave their cones least.
#pragma once

#include <limits>

#include "complementarity/shares/admissible_forces.hpp"

namespace trammel::complementarity {

inline constexpr double most_spare_load = 10;

// [N], accurate to 1e-11 of the forces. Fills F, if it is not null. If there is less than `wanted`, the result is any
// load that is less.
double spare_load(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda, Vec* F = nullptr,
                  double wanted = -std::numeric_limits<double>::infinity());

}  // namespace trammel::complementarity
