// How much further contacts could be unloaded before they can no longer carry what they carry: the cone program
//
//     maximise s,     E F = lambda,     |T| <= c (N - s)  at each contact
//
// Negative where no admissible forces have these resultants; continuous in them; no more than `most` of them where
// contacts press against each other, which bounds nothing. By cone_program.hpp.
#pragma once

#include "complementarity/shares/admissible_forces.hpp"

namespace trammel::complementarity {

constexpr double most = 10;

// [N], right to 1e-11 of the forces.
double spare_load(const std::vector<SharingContact>& contacts, const Mat& E, const Vec& lambda);

}  // namespace trammel::complementarity
