#include "simulate/event/cubic.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::numerics {
namespace {

constexpr double off_ends = 1e-3;  // of an interval: a minimum is sought no nearer to its ends
constexpr int most_iterations = 100;
constexpr double narrowest = 1e-16;  // of an interval: so near a crossing is found, below round-off except near 0

}  // namespace

double Cubic::value(double x) const {
  return at_low.f + length() * x * (at_low.slope + x * (curve() + x * twist()));
}

std::optional<Cubic::Minimum> Cubic::minimum() const {
  const double a = 3 * twist(), b = 2 * curve(), c = at_low.slope;  // slope: a x^2 + b x + c
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {};
  const double root = std::sqrt(discriminant);
  double x = b >= 0 ? -2 * c / (b + root) : (root - b) / (2 * a);  // where the slope rises
  if (at_low.slope < 0 && at_high.slope > 0) x = std::clamp(x, off_ends, 1 - off_ends);
  if (!(x >= off_ends && x <= 1 - off_ends)) return {};
  return Minimum{low + length() * x, value(x)};
}

std::optional<double> Cubic::kink_below_zero() const {
  if (!(at_low.slope < 0 && at_high.slope > 0)) return {};
  const double x = (at_low.f - at_high.f + at_high.slope * length()) / (at_high.slope - at_low.slope);
  if (!(x > 0 && x < length() && at_low.f + at_low.slope * x < 0)) return {};
  return low + x;
}

// By Newton's method and bisection.
double Cubic::crossing() const {
  const double h = length(), S = at_low.slope, C = curve(), T = twist();
  const auto at = [&](double x) {
    return ValueAndSlope{at_low.f + h * x * (S + x * (C + x * T)), h * (S + x * (2 * C + 3 * x * T))};
  };
  double begin = 0, end = 1, x = at_low.f / (at_low.f - at_high.f);
  for (int i = 0; i < most_iterations && end - begin > narrowest; ++i) {
    const ValueAndSlope there = at(x);
    (there.f > 0 ? begin : end) = x;
    const double newton = x - there.f / there.slope;
    if (newton == x) break;
    x = newton > begin && newton < end ? newton : 0.5 * (begin + end);
  }
  return low + h * x;
}

}  // namespace trammel::numerics
