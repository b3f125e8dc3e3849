#include "tspline_plate/mesh/blending.hpp"

namespace trammel::plate {

double blossom(const LocalKnots& k, int span, double x1, double x2, double x3) {
  const double x[] = {x1, x2, x3};
  std::array<double, 4> n{};
  n[std::size_t(span)] = 1;
  for (std::size_t d = 1; d <= 3; ++d)
    for (std::size_t l = 0; l + d <= 3; ++l) {
      const double rise = k[l + d] - k[l], fall = k[l + d + 1] - k[l + 1];
      const double up = rise > 0 ? (x[d - 1] - k[l]) / rise * n[l] : 0;
      const double down = fall > 0 ? (k[l + d + 1] - x[d - 1]) / fall * n[l + 1] : 0;
      n[l] = up + down;
    }
  return n[0];
}

int span_of(const LocalKnots& k, double a, double b) {
  for (std::size_t s = 0; s < 4; ++s)
    if (k[s] <= a && b <= k[s + 1] && k[s] < k[s + 1]) return int(s);
  return -1;
}

std::array<double, 4> bernstein_coefficients(const LocalKnots& k, double a, double b) {
  const int s = span_of(k, a, b);
  if (s < 0) return {};
  return {blossom(k, s, a, a, a), blossom(k, s, a, a, b), blossom(k, s, a, b, b), blossom(k, s, b, b, b)};
}

double dual_functional(const LocalKnots& dual, const LocalKnots& k) {
  for (std::size_t s : {1, 2, 0, 3}) {
    if (!(dual[s] < dual[s + 1])) continue;
    if (dual[s + 1] <= k[0] || k[4] <= dual[s]) return 0;
    const int span = span_of(k, dual[s], dual[s + 1]);
    if (span >= 0) return blossom(k, span, dual[1], dual[2], dual[3]);
  }
  return 0;
}

}  // namespace trammel::plate
