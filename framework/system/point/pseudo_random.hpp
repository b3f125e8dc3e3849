// Pseudo-random numbers, equal in every run: a direction or position that no symmetry of the model distinguishes. In
// practice no non-zero row is orthogonal to them.
#pragma once

#include <cmath>

#include <trammel/types.hpp>

namespace trammel::model {

inline Vec pseudo_random(Eigen::Index n, double size, double seed) {
  return Vec::NullaryExpr(
      n, [=](Eigen::Index i) { return size * std::sin(seed + 1.618033988749895 * double(i * i + 1)); });
}

}  // namespace trammel::model
