// A rigid body in space that touches others at up to four places.
#pragma once

#include <random>

#include "problem.hpp"

namespace trammel::complementarity {

// Tables, tripods, blocks in channels, balls in grooves and on balls, all tangents at rest, coefficients up to this.
Problem any_spatial_structure(std::mt19937& random, double most_friction);

// A heavy plate, pushed and turned, on `balls` light balls on a floor: two contacts a ball, with this coefficient. It
// leans by about the angle at which a ball is wedged.
Problem plate_on_balls(std::mt19937& random, int balls, double mu);

}  // namespace trammel::complementarity
