// `trammel static`: equilibria under growing loads, against closed forms.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <fmt/format.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;

// Two springs from (-1, 0) and (1, 0) carry a mass at (0, 1/4), which a load of t pushes down: von Mises' truss.
const std::string truss = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"apex": {"type": "point_mass", "mass": 1, "position": [0, 0.25]}},
  "forces": {
    "left": {"type": "spring_damper", "between": [{"point": [-1, 0]}, "apex.point"], "stiffness": 100, "length": "=sqrt(17)/4"},
    "right": {"type": "spring_damper", "between": [{"point": [1, 0]}, "apex.point"], "stiffness": 100, "length": "=sqrt(17)/4"},
    "load": {"type": "load", "on": "apex.point", "force": {"x": 0, "y": "=-t"}}},
  "simulate": {"until": 0.5},
  "static": {"steps": 5},
  "record": {"observe": {"x": "apex.point.x", "y": "apex.point.y"}}
})";

double load_at(double y) {
  const double length = std::hypot(1, y);
  return 200 * (std::sqrt(17) / 4 - length) * y / length;
}

TEST(Statics, FollowsTheLoadOfATruss) {
  const Finished run = run_static(truss);
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto &t = run.series.at("t"), &y = run.series.at("y");
  ASSERT_EQ(t.size(), 6u);
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_NEAR(t[i], 0.1 * double(i), 1e-15);
    EXPECT_NEAR(load_at(y[i]), t[i], 1e-9) << i;
    EXPECT_NEAR(run.series.at("x")[i], 0, 1e-12) << i;
  }
  EXPECT_EQ(run.result["load_steps"].size(), 6u);
  EXPECT_LE(int(run.result["newton_iterations"]), 20);
}

// A body on two springs under a load that grows, all lengths in a unit and x from the origin; forces go with the unit.
std::string loaded(double unit, double x) {
  const auto at = [&](double u) { return fmt::format("{:.17g}", (x + u) * unit); };
  const auto m = [&](double u) { return fmt::format("{:.17g}", u * unit); };
  const auto spring = [&](const char* name, double foot) {
    return fmt::format(R"("{0}": {{"type": "spring_damper", "between": [{{"point": [{1}, 0]}}, "b.{0}"],
        "stiffness": 50, "damping": 1, "length": {2}}})",
                       name, at(foot), m(0.5));
  };
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {}],
    "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "position": [{}, {}],
                       "markers": {{"p": [{}, {}], "q": [{}, {}]}}}}}},
    "forces": {{{}, {}, "l": {{"type": "load", "on": "b.q", "force": {{"x": "=3*{}*t", "y": "=2*{}*t"}}}}}},
    "simulate": {{"until": 1}}, "static": {{"steps": 3}},
    "record": {{"observe": {{"x": "b.com.x", "y": "b.com.y", "angle": "b.angle"}}}}}})",
                     m(-9.81), unit * unit / 12, at(0), m(-1), m(0.25), m(0.125), m(-0.25), m(0.125), spring("p", 0.5),
                     spring("q", -0.375), unit, unit);
}

TEST(Statics, AreTheSameInAnyUnitAndPlace) {
  const Finished here = run_static(loaded(1, 0));
  ASSERT_TRUE(here.done()) << here.report.reason;
  const auto expect_same = [&](double unit, double x, double off) {
    const Finished there = run_static(loaded(unit, x));
    ASSERT_TRUE(there.done()) << unit << ", " << x << ": " << there.report.reason;
    EXPECT_NEAR(there.end("x") / unit - x, here.end("x"), off) << unit << ", " << x;
    EXPECT_NEAR(there.end("y") / unit, here.end("y"), off) << unit << ", " << x;
    EXPECT_NEAR(there.end("angle"), here.end("angle"), off) << unit << ", " << x;
  };
  for (const double unit : {1e-9, 1e-6, 1e-3, 1e3, 1e6}) expect_same(unit, 0, 1e-8);
  for (const double x : {1e2, 1e4, 1e6}) expect_same(1, x, 1e-8 + 1e-14 * x);
}

// The largest load, about 0.595, is where load_at has its maximum.
double limit_load() {
  double most = 0;
  for (double y = 0; y < 0.25; y += 1e-5) most = std::max(most, load_at(y));
  return most;
}

TEST(Statics, SaysWhereTheLoadHasItsMaximumAndWhatGoesPastIt) {
  const Finished run = run_static(truss, {{"simulate.until", "1"}});
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("no equilibrium was found at t = "));
  EXPECT_THAT(run.report.reason, HasSubstr("\"arc_length\": true"));
  const double reached = run.end("t");
  EXPECT_LT(reached, limit_load());
  EXPECT_GT(reached, limit_load() - 0.2) << "one load step before, at most";
}

TEST(Statics, ArcLengthGoesPastTheLimitPointAndEndsOnTheFarBranch) {
  const Finished run = run_static(truss, {{"simulate.until", "1"}, {"static.arc_length", "true"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto &t = run.series.at("t"), &y = run.series.at("y");
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(load_at(y[i]), t[i], 1e-8) << i;
  EXPECT_LT(*std::min_element(t.begin(), t.end()), -0.9 * limit_load());  // snaps through on the way
  EXPECT_EQ(run.end("t"), 1);
  EXPECT_LT(run.end("y"), -0.25);
}

TEST(Statics, NamesTheBodyThatNothingHolds) {
  const Finished run = run_static(R"({
    "trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"held": {"type": "point_mass", "mass": 1, "position": [0, 0]},
               "loose": {"type": "point_mass", "mass": 1, "position": [2, 0]}},
    "forces": {"left": {"type": "spring_damper", "between": [{"point": [-1, 0]}, "held.point"], "stiffness": 5, "length": 0.5},
               "right": {"type": "spring_damper", "between": [{"point": [1, 0]}, "held.point"], "stiffness": 5, "length": 0.5},
               "load": {"type": "load", "on": "loose.point", "force": {"x": 0, "y": "=t"}}}})");
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("bodies.loose is a mechanism"));
}

TEST(Statics, ClosesTheRowOfAContactOnTheWay) {
  const Finished run = run_static(R"({
    "trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"ball": {"type": "point_mass", "mass": 1, "position": [0, 1]}},
    "forces": {"spring": {"type": "spring_damper", "between": [{"point": [0, 3]}, "ball.point"], "stiffness": 10, "length": 2},
               "side": {"type": "spring_damper", "between": [{"point": [-2, 1]}, "ball.point"], "stiffness": 0.1, "length": 2},
               "load": {"type": "load", "on": "ball.point", "force": {"x": 0, "y": "=-20*t"}}},
    "contacts": {"floor": {"type": "constraint_method", "restitution": 0,
                           "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
    "static": {"steps": 4},
    "record": {"observe": {"y": "ball.point.y", "force": "contacts.floor.force"}}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto &y = run.series.at("y"), &force = run.series.at("force");
  EXPECT_GT(y[1], 0.4);
  EXPECT_EQ(force[1], 0);
  for (std::size_t i = 3; i < y.size(); ++i) EXPECT_NEAR(y[i], 0, 1e-12) << i;
  EXPECT_GT(force[4] - force[3], 4.9) << "once it stands on the floor, that takes all further load";
}

TEST(Statics, OfASceneThatSaysNothingOfTimeIsOneEquilibrium) {
  const Finished run = run_static(R"({
    "trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"ball": {"type": "point_mass", "mass": 2, "position": [0.3, 1]}},
    "forces": {"spring": {"type": "spring_damper", "between": [{"point": [0.3, 2]}, "ball.point"], "stiffness": 400, "length": 1}},
    "record": {"observe": {"y": "ball.point.y"}}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (const double y : run.series.at("y")) EXPECT_NEAR(y, 1 - 20.0 / 400, 1e-10);
}

}  // namespace
}  // namespace trammel::test
