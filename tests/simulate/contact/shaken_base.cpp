// A block on a base that moves by a law of time. The block's acceleration is constant while it slides, so the steps'
// errors do not limit them, although the slip may end many times within a step as long as they allow.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double g = 9.81, mu = 0.02;  // [m/s^2], [1]

// x(t) = sum a sin(omega t + phase).
struct Quake {
  struct Term {
    double a, omega, phase;
  };
  std::vector<Term> terms;

  double velocity(double t) const {
    double v = 0;
    for (const auto& [a, omega, phase] : terms) v += a * omega * std::cos(omega * t + phase);
    return v;
  }
  double acceleration(double t) const {
    double all = 0;
    for (const auto& [a, omega, phase] : terms) all -= a * omega * omega * std::sin(omega * t + phase);
    return all;
  }
  std::string formula() const {
    std::string text = "=0";
    for (const auto& [a, omega, phase] : terms) text += fmt::format("+{:.17g}*sin({:.17g}*t+{:.17g})", a, omega, phase);
    return text;
  }
};

Quake quake(std::mt19937& random, int terms, double strongest) {
  const auto any = [&random](double from, double to) { return from + (to - from) * double(random()) / 4294967296.0; };
  Quake q;
  for (int i = 0; i < terms; ++i) {
    const double omega = 2 * 3.14159 * any(0.5, 12);
    q.terms.push_back({any(0.2, 1) * strongest * g / (omega * omega), omega, any(0, 6.28)});
  }
  return q;
}

// The displacement of the block, which is at rest at first, by the closed form of its phases: it slides with
// v' = -+ mu g until its slip changes its sign, which is sought at 1e-5 s, and sticks while |v_base'| <= mu g.
double displacement(const Quake& base, double until) {
  constexpr double fine = 1e-5;
  double t = 0, x = 0, v = 0;
  const auto sign = [](double s) { return s < 0 ? -1.0 : 1.0; };
  double direction = sign(v - base.velocity(0));
  bool sticks = false;
  const auto position = [&](double time) {
    double all = 0;
    for (const auto& [a, omega, phase] : base.terms) all += a * std::sin(omega * time + phase);
    return all;
  };
  const auto root = [](auto&& f, double low, double high) {  // f(low) > 0 >= f(high)
    for (int i = 0; i < 60; ++i) (f((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return high;
  };
  while (t < until) {
    const double from = t;
    const auto left = [&](double time) {
      return sticks ? mu * g - std::abs(base.acceleration(time))
                    : direction * (v - direction * mu * g * (time - from) - base.velocity(time));
    };
    double next = t + fine;
    while (next < until && left(next) > 0) next += fine;
    const double end = next < until ? root(left, next - fine, next) : until, dt = end - from;
    if (sticks) {
      x += position(end) - position(from), v = base.velocity(end);
    } else {
      x += dt * v - direction * mu * g * dt * dt / 2, v -= direction * mu * g * dt;
    }
    sticks = !sticks && std::abs(base.acceleration(end)) <= mu * g;
    direction = -sign(base.acceleration(end));
    t = end;
  }
  return x;
}

Finished shaken(const Quake& base, double until, double every) {
  return run_text(fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -{}],
          "bodies": {{"base": {{"type": "moving_base", "x": "{}", "markers": {{"top": [0, 0]}}}},
                      "block": {{"type": "point_mass", "mass": 1, "position": [0, 0]}}}},
          "contacts": {{"feet": {{"type": "constraint_method", "restitution": 0,
              "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1], "on": "base.top"}}}}],
              "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
          "record": {{"every": {:.17g}, "observe": {{"x": "block.point.x"}}}}, "simulate": {{"until": {:.17g}}}}})",
      g, base.formula(), mu, mu, every, until));
}

// However seldom results are recorded, by which the longest step is chosen.
TEST(BlockOnAShakenBase, MovesAsItsPhasesInClosedForm) {
  std::mt19937 random(1);
  for (int i = 0; i < 12; ++i) {
    const Quake base = quake(random, 1 + i % 4, 0.3);
    const double until = 8, x = displacement(base, until);
    for (const double every : {0.008, 0.04, 0.4}) {
      const Finished run = shaken(base, until, every);
      ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
      // 1e-5 s hide a stick phase of 1e-5 s, in which little moves.
      EXPECT_NEAR(run.end("x"), x, 1e-7) << i << ", recorded every " << every << " s";
      EXPECT_THAT(run.report.summary, Not(HasSubstr("not to be trusted"))) << i;
    }
  }
}

}  // namespace
}  // namespace trammel::test
