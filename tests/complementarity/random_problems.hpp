// Problems without a picture: contacts of every kind on a system of some random velocities.
#pragma once

#include <random>

#include "problem.hpp"

namespace trammel::complementarity {

struct RandomKinds {
  int contacts = 4;
  int velocities = 8;  // fewer than rows: dependent ones
  double noise = 0;  // of b, that no acceleration of the system explains: contradictory where rows depend on each other
  double most_friction = 1;  // coefficients are between 0 and this
  bool unilateral_only = false;
  bool resting_only = false;
};

Problem random_planar(std::mt19937& random, const RandomKinds& kinds);
// Of some number of contacts, rank, coefficients.
Problem any_planar(std::mt19937& random, int contacts);

// n normals of a system of `velocities`, pressed; b is what some acceleration of it does, and noise.
Problem random_normals(std::mt19937& random, int n, int velocities, double noise);

// In space, all tangents in pairs.
Problem random_spatial(std::mt19937& random, const RandomKinds& kinds);

std::vector<std::size_t> random_order(std::mt19937& random, std::size_t n);

}  // namespace trammel::complementarity
