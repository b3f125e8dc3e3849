// Sums along a few numbers, as fronts have them: 4 to 30, where the calls around a general product would cost more than
// its work.
#pragma once

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// y += a x, which do not overlap
inline void add(int n, double a, const double* __restrict x, double* __restrict y) {
  for (int i = 0; i < n; ++i) y[i] += a * x[i];
}

// In the same order wherever x and y lie in memory: every run rounds alike.
inline double dot(int n, const double* x, const double* y) {
  Pack sum = Pack::Zero();
  int i = 0;
  for (; i + pack <= n; i += pack) sum += pack_at(x + i) * pack_at(y + i);
  double all = sum.sum();
  for (; i < n; ++i) all += x[i] * y[i];
  return all;
}

}  // namespace trammel::numerics
