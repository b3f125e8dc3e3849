// A rigid body in space that touches others at up to four places.
#pragma once

#include <random>

#include "problem.hpp"

namespace trammel::complementarity {

// Tables, tripods, blocks in channels, balls in grooves and on balls, all tangents at rest, coefficients up to this.
Problem any_spatial_structure(std::mt19937& random, double most_friction);

}  // namespace trammel::complementarity
