// Pseudo-random numbers, the same in every run: a direction or position in general position, not special by a symmetry
// of the model. In practice no non-zero row is orthogonal to them.
#pragma once

#include <cmath>

#include <trammel/types.hpp>

namespace trammel::model {

inline Vec pseudo_random(Eigen::Index n, double size, double seed) {
  return Vec::NullaryExpr(
      n, [=](Eigen::Index i) { return size * std::sin(seed + 1.618033988749895 * double(i * i + 1)); });
}

}  // namespace trammel::model
