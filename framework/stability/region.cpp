#include "stability/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trammel::stability {

namespace {

// The boundary is bracketed by steps of omega h of this length, then bisected to 3e-6.
constexpr double bracket = 0.05;
constexpr int bisections_of_boundary = 14;

double spectral_radius(const std::vector<std::complex<double>>& roots) {
  double largest = 0;
  for (const std::complex<double> root : roots) largest = std::max(largest, std::abs(root));
  return largest;
}

// Of a row or a motion; a rejected step counts as unstable.
template <class Measure>
double radius_of(Measure&& measure) {
  try {
    return measure();
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
}

// zeta = cos(phi) from phi = 0 (the real axis, zeta = 1) to pi/2 (the imaginary one, 0).
std::vector<double> ratios(int rays) {
  std::vector<double> all;
  for (int i = 0; i < rays; ++i) {
    const double zeta = std::cos(std::numbers::pi / 2 * i / (rays - 1));
    all.push_back(i == rays - 1 ? 0 : zeta);
  }
  return all;
}

template <class Measured>
std::vector<BoundaryPoint> region(const Measured& measured, const LinearTheory* theory, double most, int rays) {
  std::vector<BoundaryPoint> points;
  for (const double zeta : ratios(rays)) {
    BoundaryPoint point{.zeta = zeta, .measured = boundary([&](double Omega) { return measured(Omega, zeta); }, most)};
    point.open = point.measured >= most;
    if (theory)
      point.theory = boundary([&](double Omega) { return spectral_radius(theory->roots(Omega, zeta)); }, most);
    points.push_back(point);
  }
  return points;
}

}  // namespace

double boundary(const std::function<double(double)>& radius, double most) {
  const auto unstable = [&](double Omega) { return radius(Omega) > 1 + growth; };
  double low = 0, high = bracket;
  while (!unstable(high)) {
    if (high >= most) return most;
    low = high, high += bracket;
  }
  for (int i = 0; i < bisections_of_boundary; ++i) (unstable((low + high) / 2) ? high : low) = (low + high) / 2;
  return high;
}

std::vector<BoundaryPoint> motion_region(const Maker& method, const LinearTheory* theory, double most, int rays) {
  const auto measured = [&](double Omega, double zeta) {
    return radius_of([&] { return amplification(method, Omega, zeta).radius; });
  };
  return region(measured, theory, most, rays);
}

std::vector<BoundaryPoint> row_region(const RowMaker& method, const LinearTheory* theory, double most, int rays) {
  const auto measured = [&](double Omega, double zeta) {
    return radius_of([&] { return row_amplification(method(zeta * Omega, Omega)).radius; });
  };
  return region(measured, theory, most, rays);
}

}  // namespace trammel::stability
