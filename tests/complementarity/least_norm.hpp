// Whether forces of planar contacts have the least norm of all with the same accelerations.
#pragma once

#include "problem.hpp"

namespace trammel::complementarity {

// Where no contact slides the forces of closed contacts with the same accelerations are those with the same A F, and F
// is the least of them exactly where it is what some A y projects to: A y - F is normal to the cones. Returns how far
// it is from that, of the largest force; `nothing`: smaller is no acceleration.
double distance_from_least_norm(const Problem& problem, const Vec& F, const Vec& a, double nothing);

// Whether some closed contact slides.
bool slides(const Problem& problem, const Vec& a, double nothing);

}  // namespace trammel::complementarity
