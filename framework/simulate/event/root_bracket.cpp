#include "simulate/event/root_bracket.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/math/tools/toms748_solve.hpp>

namespace trammel::numerics {

namespace {

constexpr std::uintmax_t most_evaluations = 200;  // bisection to `resolution`, 2 eps of the time or more: about 52
constexpr int most_trials = 200;                  // likewise

}  // namespace

Interval narrow(const std::function<double(double)>& f, const RootBracket& bracket, double resolution) {
  std::uintmax_t evaluations = most_evaluations;
  const auto narrow_enough = [resolution](double low, double high) { return high - low <= resolution; };
  const auto [low, high] = boost::math::tools::toms748_solve(f, bracket.low, bracket.high, bracket.f_low,
                                                             bracket.f_high, narrow_enough, evaluations);
  return {low, high};
}

// Each trial is placed a little after the crossing of the cubic, as far as round-off reaches, so that it becomes the
// new upper end.
double crossing(const std::function<ValueAndSlope(double)>& f, Cubic b, double resolution, double round_off) {
  bool bisect = false;
  for (int i = 0; i < most_trials && b.high - b.low > resolution; ++i) {
    if (b.at_high.f >= -round_off || -b.at_high.f <= resolution * -b.at_high.slope) break;
    const double slope = std::abs(b.at_low.f <= -b.at_high.f ? b.at_low.slope : b.at_high.slope);
    const double after = slope > 0 ? std::max(0.5 * resolution, 0.5 * round_off / slope) : 0.5 * resolution;
    double x = bisect ? 0.5 * (b.low + b.high) : b.crossing() + after;
    if (!(x > b.low && x < b.high)) x = 0.5 * (b.low + b.high);
    const ValueAndSlope there = f(x);
    const double nearest = std::min(b.at_low.f, -b.at_high.f);
    bisect = !(std::abs(there.f) <= 0.25 * nearest);
    if (there.f > 0)
      b.low = x, b.at_low = there;
    else
      b.high = x, b.at_high = there;
  }
  return b.high;
}

}  // namespace trammel::numerics
