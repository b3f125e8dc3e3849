// Sums along a few numbers, as fronts have them: 4 to 30, where the calls around a general product would cost more than its work.
#pragma once

#include <Eigen/Core>

namespace trammel::numerics {

// y += a x
inline void add(int n, double a, const double* x, double* y) {
  for (int i = 0; i < n; ++i) y[i] += a * x[i];
}

inline double dot(int n, const double* x, const double* y) {
  using Segment = Eigen::Map<const Eigen::VectorXd>;
  return Segment(x, n).dot(Segment(y, n));
}

}  // namespace trammel::numerics
