// Bodies at rest whose loads exceed what friction or weight holds for a short time only. Where nothing moves, error
// control allows long steps, so loads and not errors bound the steps.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "support/run_in_pieces.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

constexpr double g = 9.81, until = 2, mass = 1.7, mu = 0.4;  // [m/s^2], [s], [kg], [1]

struct Random {
  std::mt19937 engine;
  double operator()(double from, double to) { return from + (to - from) * double(engine()) / 4294967296.0; }
};

// Loads along and up, and the acceleration of the base along; the formula of each, and its value.
struct Shaken {
  std::string along = "0", up = "0", base = "0";
  std::function<double(double)> load = [](double) { return 0.0; }, lift = load, acceleration = load;
  double from = 0, to = until;  // [s] outside of which the limit is not reached

  double spare(double t) const {  // [N] of friction; the weight minus the lift where that is less
    const double normal = mass * g - lift(t);
    return std::min(normal, mu * normal - std::abs(load(t) - mass * acceleration(t)));
  }
};

// A point mass on a floor.
Finished run(const Shaken& shaken, double every, double x = 0.3) {
  return run_text(fmt::format(
      R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
          "bodies": {{"base": {{"type": "moving_base", "x": "={}", "markers": {{"top": [0, 0]}}}},
                      "block": {{"type": "point_mass", "mass": {}, "position": [{}, 0]}}}},
          "forces": {{"hand": {{"type": "load", "on": "block.point", "force": {{"x": "={}", "y": "={}"}}}}}},
          "contacts": {{"foot": {{"type": "constraint_method", "restitution": 0,
              "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1], "on": "base.top"}}}}],
              "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
          "record": {{"every": {}}}, "simulate": {{"until": {}}}}})",
      shaken.base, mass, x, shaken.along, shaken.up, mu, mu, every, until));
}

std::optional<double> onset(const Shaken& shaken) {
  constexpr int parts = 4000;
  double low = shaken.from;
  for (int i = 1; i <= parts; ++i) {
    double high = shaken.from + (shaken.to - shaken.from) * i / parts;
    if (shaken.spare(high) >= 0) {
      low = high;
      continue;
    }
    for (int k = 0; k < 60; ++k) (shaken.spare((low + high) / 2) < 0 ? high : low) = (low + high) / 2;
    return high;
  }
  return {};
}

// Events at t = 0, or a rounding of it later, say how the scene starts.
std::optional<double> first_event(const Finished& run) {
  for (const Event& event : run.events)
    if (event.t > 1e-6) return event.t;
  return {};
}

// Loads that reach `size` times the limit in peaks of a width of 1e-4 s to 0.1 s.
Shaken peak(Random& random, int kind, double size) {
  const double at = random(0.3, 1.6), w = std::pow(10, random(-4, -1)), limit = mu * mass * g;
  const double A = size * limit, L = size * mass * g;
  Shaken s;
  s.from = at - 6 * w, s.to = std::min(until, at + 8 * w);
  switch (kind) {
    case 0:
      s.along = fmt::format("{:.17g}*exp(-((t-{:.17g})/{:.17g})^2)", A, at, w);
      s.load = [=](double t) { return A * std::exp(-std::pow((t - at) / w, 2)); };
      break;
    case 1:
      s.along = fmt::format("{:.17g}*max(0,1-abs(t-{:.17g})/{:.17g})", A, at, w);
      s.load = [=](double t) { return A * std::max(0.0, 1 - std::abs(t - at) / w); };
      break;
    case 2:
      s.along = fmt::format("{:.17g}*(step(t-{:.17g})-step(t-{:.17g}))", A, at, at + w);
      s.load = [=](double t) { return at <= t && t < at + w ? A : 0; };
      break;
    case 3:
      s.up = fmt::format("{:.17g}/(1+((t-{:.17g})/{:.17g})^2)", L, at, w);
      s.lift = [=](double t) { return L / (1 + std::pow((t - at) / w, 2)); };
      break;
    case 4: {
      const double a = size * mu * g * w * w / 2;
      s.base = fmt::format("{:.17g}*exp(-((t-{:.17g})/{:.17g})^2)", a, at, w);
      s.acceleration = [=](double t) {
        const double z = (t - at) / w;
        return a * std::exp(-z * z) * (4 * z * z - 2) / (w * w);
      };
      break;
    }
    default: {  // the load falls after the lift has risen: each alone, and both at any one end of a long step, are held
      const double later = at + random(0, 2) * w, part = random(0.6, 0.9);
      s.along = fmt::format("{:.17g}*0.5*(1-tanh((t-{:.17g})/{:.17g}))", part * limit, later, w);
      s.up = fmt::format("{:.17g}*0.5*(1+tanh((t-{:.17g})/{:.17g}))", part * mass * g, at, w);
      s.load = [=](double t) { return part * limit * 0.5 * (1 - std::tanh((t - later) / w)); };
      s.lift = [=](double t) { return part * mass * g * 0.5 * (1 + std::tanh((t - at) / w)); };
    }
  }
  return s;
}

// Located to 1e-7 s and a millionth of the peak's width, that of a force which crosses its limit at a small angle.
TEST(ShortLoads, MoveABodyAtRestWhenTheyExceedItsLimit) {
  Random random{std::mt19937(1)};
  int moved = 0;
  for (int i = 0; i < 60; ++i) {
    const double size = random(0, 1) < 0.25 ? 0.98 : random(0, 1) < 0.5 ? 1.02 : 1.3;
    const Shaken shaken = peak(random, i % 6, size);
    const std::optional<double> expected = onset(shaken);
    const Finished finished = run(shaken, std::pow(10, random(-2.5, -0.7)));
    const std::optional<double> found = first_event(finished);
    ASSERT_TRUE(finished.done()) << i << ": " << finished.report.reason;
    ASSERT_EQ(found.has_value(), expected.has_value())
        << i << ": " << shaken.along << ", " << shaken.up << ", " << shaken.base;
    EXPECT_THAT(finished.result["warnings"].dump(), testing::Not(testing::HasSubstr("trusted"))) << i;
    if (!expected) continue;
    EXPECT_NEAR(*found, *expected, 1e-7) << i << ": " << shaken.along << ", " << shaken.up << ", " << shaken.base;
    ++moved;
  }
  EXPECT_GT(moved, 30);
}

// The base begins with speeds like 1e-78 m/s at the origin, so the scene shows no length and no speed at first.
TEST(ShortLoads, OfABaseThatBeginsFarBelowAnySpeedMoveABody) {
  Random random{std::mt19937(2)};
  for (int i = 0; i < 12; ++i) {
    const Shaken shaken = peak(random, 4, 1.1);
    const Finished finished = run(shaken, 0.02, 0);
    ASSERT_TRUE(finished.done()) << shaken.base << ": " << finished.report.reason;
    EXPECT_THAT(finished.result["warnings"].dump(), testing::Not(testing::HasSubstr("trusted"))) << shaken.base;
    EXPECT_NEAR(first_event(finished).value_or(0), onset(shaken).value(), 1e-7) << shaken.base;
  }
}

// Both loads begin with 1e-300 N, where the square of a slip underflows. They have one shape g, so the mass slides from
// the beginning: m v' = (push - mu press) g, v at the end by the integral of g, w sqrt(pi).
TEST(ShortLoads, ThatBeginBelowAnyNumberGiveSlipsItsDirection) {
  Random random{std::mt19937(3)};
  for (int i = 0; i < 20; ++i) {
    const double press = random(2, 9), push = (mu + random(0.05, 0.5)) * press, at = random(0.4, 0.6),
                 w = random(0.01, 0.02);
    const std::string g_of_t = fmt::format("exp(-((t-{:.17g})/{:.17g})^2)", at, w);
    const Finished finished = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
            "bodies": {{"block": {{"type": "point_mass", "mass": {}, "position": [0, 0]}}}},
            "forces": {{"hand": {{"type": "load", "on": "block.point",
                                  "force": {{"x": "={:.17g}*{}", "y": "=-{:.17g}*{}"}}}}}},
            "contacts": {{"foot": {{"type": "constraint_method", "restitution": 0,
                "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
            "record": {{"every": 0.02, "observe": {{"v": "block.point.vx"}}}}, "simulate": {{"until": 1}}}})",
        mass, push, g_of_t, press, g_of_t, mu, mu));
    ASSERT_TRUE(finished.done()) << g_of_t << ": " << finished.report.reason;
    EXPECT_THAT(finished.result["warnings"].dump(), testing::Not(testing::HasSubstr("trusted"))) << g_of_t;
    EXPECT_NEAR(finished.end("v"), (push - mu * press) * w * std::sqrt(std::numbers::pi) / mass, 1e-9) << g_of_t;
  }
}

// The steps follow the loads only while these vary.
TEST(ShortLoads, CostNoStepsWhereTheyAreSlow) {
  Shaken slow;
  slow.along = "1+t";
  const Finished finished = run(slow, 0.1);
  ASSERT_TRUE(finished.done());
  EXPECT_LT(finished.end("steps"), 20);
}

// No gravity: it comes to rest under a load that fades away. Its slips are round-off of its place then, and forces that
// end them by Baumgarte's stabilisation are round-off, too.
TEST(BlockOnAFloor, RestsInFewStepsAfterItsLoadHasFadedAway) {
  Random between{std::mt19937(4)};
  for (int i = 0; i < 10; ++i) {
    const double w = between(0.1, 0.3), h = between(0.2, 0.4), m = between(0.5, 3), pressed = between(1e2, 1e5);
    const std::string fading = fmt::format("exp(-t/{:.17g})", between(0.003, 0.01));
    const std::string block = fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
            "bodies": {{"block": {{"type": "rigid_body", "mass": {0:.17g}, "inertia": {1:.17g},
                "position": [0, {3:.17g}], "velocity": [{4:.17g}, 0],
                "markers": {{"l": [-{2:.17g}, -{3:.17g}], "r": [{2:.17g}, -{3:.17g}],
                             "hand": [{5:.17g}, {6:.17g}]}}}}}},
            "forces": {{"hand": {{"type": "load", "on": "block.hand",
                "force": {{"x": "={7:.17g}*{8}", "y": "=-{9:.17g}*{8}"}}}}}},
            "contacts": {{
              "l": {{"type": "constraint_method", "restitution": 0,
                "between": ["block.l", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                "friction": {{"type": "coulomb", "static": 0.7, "kinetic": 0.7}}}},
              "r": {{"type": "constraint_method", "restitution": 0,
                "between": ["block.r", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                "friction": {{"type": "coulomb", "static": 0.7, "kinetic": 0.7}}}}}},
            "record": {{"every": 0.02}}, "simulate": {{"until": 1}}}})",
        m, m * (w * w + h * h) / 3, w, h, between(0.01, 0.1), between(-w / 3, w / 3), -between(0.2, 0.6) * h,
        0.2 * pressed, fading, pressed);
    const Finished run = run_text(block);
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_LT(run.result["counts"]["steps"], 2000) << i;
    if (i > 0) continue;
    const scene::Scene scene = scene::Scene::parse(block, "test.json", {});
    const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 1);
    EXPECT_EQ(whole.series, pieces.series);
    EXPECT_EQ(whole.events, pieces.events);
  }
}

}  // namespace
}  // namespace trammel::test
