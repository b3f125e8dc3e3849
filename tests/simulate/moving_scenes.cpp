// A scene that moves as a whole has the same events.
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using ::testing::HasSubstr;

constexpr double eps = std::numeric_limits<double>::epsilon();

void expect_same(const std::vector<Event>& here, const std::vector<Event>& there, double off, const std::string& what) {
  ASSERT_EQ(there.size(), here.size()) << what;
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(there[i].contact, here[i].contact) << what << ", event " << i;
    EXPECT_EQ(there[i].kind, here[i].kind) << what << ", event " << i;
    EXPECT_NEAR(there[i].t, here[i].t, off) << what << ", event " << i;
  }
}

// Points that bounce slowly in a box that moves with them.
constexpr double width = 1e-3, slow = 5e-4, seconds = 20;

std::string gas(unsigned seed, double vx, double vy) {
  std::mt19937 random(seed);
  const auto draw = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const auto velocity = [&] { return std::copysign(draw(0.5, 1) * slow, draw(-1, 1)); };
  std::string bodies = fmt::format(
      R"("box": {{"type": "rigid_body", "mass": 10, "inertia": 1e6, "position": [0, 0], "velocity": [{:.17g}, {:.17g}]}})",
      vx, vy);
  std::string contacts;
  for (int i = 0; i < 3; ++i) {
    const double x = draw(-0.4, 0.4) * width, y = draw(-0.4, 0.4) * width;
    bodies += fmt::format(
        R"(, "p{}": {{"type": "point_mass", "mass": 1, "position": [{:.17g}, {:.17g}], "velocity": [{:.17g}, {:.17g}]}})",
        i, x, y, vx + velocity(), vy + velocity());
    for (const auto& [nx, ny] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
      contacts += fmt::format(
          R"({}"p{}_{}{}": {{"type": "constraint_method", "restitution": {:.17g},
              "between": ["p{}.point", {{"plane": {{"point": [{:.17g}, {:.17g}], "normal": [{}, {}], "on": "box.com"}}}}]}})",
          contacts.empty() ? "" : ", ", i, nx + 1, ny + 1, draw(0.7, 1), i, -nx * width / 2, -ny * width / 2, nx, ny);
  }
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, 0], "bodies": {{{}}}, "contacts": {{{}}},
  "simulate": {{"until": {}}}, "record": {{"every": 1, "observe": {{"x": "box.com.x"}}}}}})",
                     bodies, contacts, seconds);
}

TEST(AMovingScene, HasTheSameImpacts) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Finished here = run_text(gas(seed, 0, 0));
    ASSERT_TRUE(here.done()) << here.report.reason;
    ASSERT_GT(here.events.size(), 10u);
    for (const double v : {1e-2, 1.0, 100.0, 7800.0}) {
      const Finished there = run_text(gas(seed, v, -v / 2));
      ASSERT_TRUE(there.done()) << there.report.reason;
      // Places of v seconds are rounded, over the speed; each of some ten bounces doubles it.
      expect_same(here.events, there.events, 1e-9 + 1e3 * eps * v * seconds / slow,
                  fmt::format("seed {}, {} m/s", seed, v));
    }
  }
}

// A block that slides on a table to rest.
std::string sliding(const char* space, const std::string& slip, double v) {
  const bool spatial = std::string(space) == "spatial";
  return fmt::format(
      R"({{"trammel": 1, "space": "{}", "gravity": [0, {}-10],
  "bodies": {{"table": {{"type": "moving_base", "x": "={:.17g}*t"}},
             "block": {{"type": "point_mass", "mass": 1, "position": [0, 0{}], "velocity": {}}}}},
  "contacts": {{"c": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 0.2, "kinetic": 0.2}},
                      "between": ["block.point", {{"plane": {{"point": [0, 0{}], "normal": [0, {}1], "on": "table.origin"}}}}]}}}},
  "simulate": {{"until": 0.1}}, "record": {{"every": 0.01, "observe": {{"x": "block.point.x"}}}}}})",
      space, spatial ? "0, " : "", v, spatial ? ", 0" : "", slip, spatial ? ", 0" : "", spatial ? "0, " : "");
}

TEST(AMovingScene, HasTheSameStops) {
  for (const double v : {0.0, 1e-2, 1.0, 100.0, 7800.0})
    for (const double u : {1e-2, 1e-4}) {
      const double off = 1e-12 + 1e3 * eps * v / 2;  // some hundred roundings of the velocity
      const Finished planar = run_text(sliding("planar", fmt::format("[{:.17g}, 0]", v + u), v));
      const Finished spatial =
          run_text(sliding("spatial", fmt::format("[{:.17g}, {:.17g}, 0]", v + 0.6 * u, 0.8 * u), v));
      for (const Finished* run : {&planar, &spatial}) {
        ASSERT_TRUE(run->done()) << run->report.reason;
        ASSERT_EQ(run->of_kind("stick").size(), 1u) << v << ", " << u;
        EXPECT_NEAR(run->of_kind("stick")[0].t, u / 2, off) << v << ", " << u;
      }
    }
}

// Moved by 1e8 m, where coordinates are rounded to 1.5e-8 m: it asks for no shorter steps than here, and ends as near
// as some hundred roundings allow.
TEST(ASceneFarAway, TakesStepsThatItsPlaceResolves) {
  const auto pendulum = [](double place) {
    return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
  "bodies": {{"bob": {{"type": "point_mass", "mass": 1, "position": [{0:.17g}, {1:.17g}]}}}},
  "joints": {{"rod": {{"type": "distance", "between": [{{"point": [{2:.17g}, {2:.17g}]}}, "bob.point"], "length": 1}}}},
  "simulate": {{"until": 2}}, "record": {{"every": 0.1, "observe": {{"x": "bob.point.x"}}}}}})",
                                place + 0.6, place - 0.8, place));
  };
  const auto block = [](double place) {
    return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [3, -9.81],
  "bodies": {{"p": {{"type": "point_mass", "mass": 3, "position": [{0:.17g}, {0:.17g}]}}}},
  "contacts": {{"floor": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 0.1, "kinetic": 0.1}},
      "between": ["p.point", {{"plane": {{"point": [{0:.17g}, {0:.17g}], "normal": [-0.28, 0.96]}}}}]}}}},
  "simulate": {{"until": 2}}, "record": {{"every": 0.1, "observe": {{"x": "p.point.x"}}}}}})",
                                place));
  };
  for (const double place : {1e6, 1e8}) {
    const double off = 1e-8 + 300 * eps * place;
    for (const auto& [here, there] : {std::pair(pendulum(0), pendulum(place)), std::pair(block(0), block(place))}) {
      ASSERT_TRUE(here.done() && there.done()) << there.report.reason;
      EXPECT_NEAR(there.end("x") - place, here.end("x"), off) << place;
      EXPECT_LT(there.result["counts"]["steps"].get<double>(), 20 * here.result["counts"]["steps"].get<double>() + 200);
    }
  }
}

// A block that slides under compliant contact, decided at every step, in any unit of length.
std::string by_every_step(double unit, const std::string& more) {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {:.17g}],
  "bodies": {{"p": {{"type": "point_mass", "mass": 1, "position": [0, {:.17g}], "velocity": [{:.17g}, 0]}}}},
  "contacts": {{"floor": {{"type": "continuous_force", "stiffness": 1e4, "exponent": 1, "restitution": 0.5,
      "between": ["p.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
      "friction": {{"type": "coulomb", "static": 0.2, "kinetic": 0.2, "method": "lcp_every_step"{}}}}}}},
  "simulate": {{"until": 0.4}}, "record": {{"every": 0.01, "observe": {{"v": "p.point.vx"}}}}}})",
                     -10 * unit, -1e-3 * unit, unit, more);
}

TEST(StickSpeed, FollowsTheScene) {
  for (const double unit : {1e-9, 1e-7, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    const Finished run = run_text(by_every_step(unit, ""));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.end("v") / unit, 1 - 0.2 * 10 * 0.4, 1e-9) << unit << " m";
    EXPECT_EQ(run.result.at("warnings").dump(), "[]") << unit << " m";
  }
}

TEST(StickSpeed, ThatExceedsASlipIsReported) {
  const Finished run = run_text(by_every_step(1e-6, R"(, "stick_speed": 1e-6)"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_THAT(run.result.at("warnings").dump(), HasSubstr("contacts.floor.friction.stick_speed is 1e-06 m/s"));
}

// The law's 1 mm/s is the whole motion of a block that slides by millimetres.
TEST(Creep, OfASmoothLawIsReportedWhereItIsTheMotion) {
  const auto sliding = [](double speed) {
    return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {{"p": {{"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [{0:.17g}, 0]}},
             "q": {{"type": "point_mass", "mass": 1, "position": [{1:.17g}, 0]}}}},
  "forces": {{"drive": {{"type": "spring_damper", "between": ["p.point", "q.point"], "stiffness": 1, "length": {1:.17g}}}}},
  "contacts": {{"floor": {{"type": "constraint_method", "between": ["p.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
      "friction": {{"type": "regularized_coulomb", "coefficient": 1e-4}}}},
               "base": {{"type": "constraint_method", "between": ["q.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": 1}}, "record": {{"every": 0.01, "observe": {{"v": "p.point.vx"}}}}}})",
                                speed, speed));
  };
  const Finished fast = sliding(1), creeping = sliding(2e-3);
  ASSERT_TRUE(fast.done() && creeping.done()) << creeping.report.reason;
  EXPECT_EQ(fast.result.at("warnings").dump(), "[]");
  EXPECT_THAT(creeping.result.at("warnings").dump(), HasSubstr("the fastest slip of contacts.floor was 0.002 m/s"));
}

// Tied to a body of metres, which would fall faster than all others move.
TEST(CaptureSpeed, OfTheSceneThatExceedsAllImpactsIsReported) {
  const auto thrown = [](double speed) {
    return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {{"p": {{"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [{:.17g}, 0]}},
             "q": {{"type": "rigid_body", "mass": 1, "inertia": 1, "position": [1, 2], "markers": {{"end": [2, 0]}}}}}},
  "joints": {{"rail": {{"type": "point_on_line", "between": ["ground", "p.point"], "axis": [1, 0]}}}},
  "forces": {{"tie": {{"type": "spring_damper", "between": ["p.point", "q.com"], "stiffness": 1e-30, "length": 1}}}},
  "contacts": {{"wall": {{"type": "constraint_method", "restitution": 1,
                         "between": ["p.point", {{"plane": {{"point": [{:.17g}, 0], "normal": [-1, 0]}}}}]}},
               "floor": {{"type": "constraint_method", "between": ["q.com", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
  "simulate": {{"until": 1}}, "record": {{"every": 1, "observe": {{"v": "p.point.vx"}}}}}})",
                                speed, speed / 2));
  };
  const Finished fast = thrown(1e-5), slower = thrown(1e-8);
  ASSERT_TRUE(fast.done() && slower.done()) << slower.report.reason;
  EXPECT_NEAR(fast.end("v"), -1e-5, 1e-14);
  EXPECT_EQ(fast.result.at("warnings").dump(), "[]");
  EXPECT_THAT(slower.result.at("warnings").dump(), HasSubstr("no impact of contacts.wall was faster than"));
}

}  // namespace
}  // namespace trammel::test
