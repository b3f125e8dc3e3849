// How much further contacts could be unloaded before they cannot carry their resultants: the cone program
//
//     maximise s,     E F = lambda,     |T| <= c (N - s)  at each contact
//
// Negative if no admissible forces have these resultants; a continuous function of them. Limited to `most` of them,
// because s is unbounded for contacts that press against each other. Solved by cone_program.hpp.
#pragma once

#include "complementarity/shares/admissible_forces.hpp"

namespace trammel::complementarity {

constexpr double most = 10;

// [N], accurate to 1e-11 of the forces.
double spare_load(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda);

}  // namespace trammel::complementarity
