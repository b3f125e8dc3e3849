// Numbers without a relation between them, the same in every run: a direction or a place that no symmetry of a model singles out.
// No row but 0 is orthogonal to them all.
#pragma once

#include <cmath>

#include <trammel/types.hpp>

namespace trammel::simulate {

inline Vec pseudo_random(Eigen::Index n, double size, double seed) {
  return Vec::NullaryExpr(
      n, [=](Eigen::Index i) { return size * std::sin(seed + 1.618033988749895 * double(i * i + 1)); });
}

}  // namespace trammel::simulate
