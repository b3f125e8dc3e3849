// Sums of a few numbers, as in fronts: 4 to 30, for which the calls around a general product cost more than its work.
#pragma once

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// y += a x; x and y do not overlap.
inline void add(int n, double a, const double* __restrict x, double* __restrict y) {
  for (int i = 0; i < n; ++i) y[i] += a * x[i];
}

// Adds in a fixed order, whatever the alignment of x and y, so that every run rounds alike.
inline double dot(int n, const double* x, const double* y) {
  Pack sum{};
  int i = 0;
  for (; i + pack <= n; i += pack) sum += pack_at(x + i) * pack_at(y + i);
  double all = total(sum);
  for (; i < n; ++i) all += x[i] * y[i];
  return all;
}

}  // namespace trammel::numerics
