// Friction in joints that repeat each other's rows: doors with several hinges, planar linkages in space. Many reactions
// are possible, and friction follows from the least of them.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

std::string coulomb(double mu) {
  return fmt::format(R"({{"type": "coulomb", "static": {0}, "kinetic": {0}}})", mu);
}

struct Door {
  double mass = 10, width = 1, inertia = 10.0 / 3, mu = 0.3, radius = 0.02, omega = 2;  // inertia about the hinges
};

// Hinges at these heights; `rubbing` of them have friction.
std::string door(const Door& d, const std::vector<double>& heights, std::size_t rubbing) {
  std::string joints, markers, loads;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const char* comma = i == 0 ? "" : ", ";
    const bool rubs = i < rubbing;
    markers += fmt::format(R"({}"h{}": [{}, 0, {}])", comma, i, -d.width / 2, heights[i]);
    joints += fmt::format(R"({}"h{}": {{"type": "revolute", "between": [{{"point": [0, 0, {}]}}, "door.h{}"]{}}})",
                          comma, i, heights[i], i,
                          rubs ? fmt::format(R"(, "radius": {}, "friction": {})", d.radius, coulomb(d.mu)) : "");
    if (rubs) loads += fmt::format(R"(, "load{0}": "joints.h{0}.load")", i);
  }
  return fmt::format(
      R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, 0],
           "bodies": {{"door": {{"type": "rigid_body", "mass": {}, "inertia": [3, 3, {}], "position": [{}, 0, 0],
                                 "velocity": [0, {}, 0], "angular_velocity": [0, 0, {}], "markers": {{{}}}}}}},
           "joints": {{{}}}, "simulate": {{"until": 1}},
           "record": {{"every": 0.1, "observe": {{"omega": "door.omega_z"{}}}}}}})",
      d.mass, d.inertia - d.mass * d.width * d.width / 4, d.width / 2, d.omega * d.width / 2, d.omega, markers, joints,
      loads);
}

// The hinges carry equal parts of m (W/2) hypot(omega^2, alpha). With k = mu r m (W/2) / I for the part that rubs:
// alpha = -k hypot(omega^2, alpha), so omega = omega_0 / (1 + k t omega_0 / sqrt(1 - k^2)).
TEST(DoorOnHingesThatRub, SlowsDownByTheLeastReactionsThatHoldIt) {
  const Door d;
  struct Hinges {
    std::vector<double> heights;
    std::size_t rubbing;
  };
  for (const auto& [heights, rubbing] : {Hinges{{-0.8, 0.8}, 2},
                                         {{-0.8, 0.8}, 1},
                                         {{-0.8, -0.3, 0.3, 0.8}, 4},
                                         {{0.3, -0.8, 0.8, -0.3}, 4},
                                         {{-0.8, 0, 0.8}, 3}}) {
    const Finished run = run_text(door(d, heights, rubbing));
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double part = double(rubbing) / double(heights.size());
    const double k = part * d.mu * d.radius * d.mass * d.width / 2 / d.inertia, slows = k / std::sqrt(1 - k * k);
    const double omega = d.omega / (1 + slows * d.omega);
    EXPECT_NEAR(run.end("omega"), omega, 1e-8) << heights.size();
    const double load = d.mass * d.width / 2 * omega * omega * std::hypot(1, slows) / double(heights.size());
    for (std::size_t i = 0; i < rubbing; ++i)
      EXPECT_NEAR(run.end(fmt::format("load{}", i)), load, 1e-6 * load) << heights.size() << ", " << i;
  }
}

// A crank, a coupler and a rocker whose hinges rub. In space the loop has three rows too many; by symmetry about its
// plane the least reactions are those in the plane. The slips of some hinges reverse on the way.
std::string four_bar(bool spatial) {
  const auto vector = [spatial](double x, double y) {
    return spatial ? fmt::format("[{}, {}, 0]", x, y) : fmt::format("[{}, {}]", x, y);
  };
  const double crank = 2.33, coupler = 0.5309147384288446, rocker = 2.026979131550375;
  const auto body = [&](const char* name, double mass, double inertia, double x, double y, double angle, double omega,
                        double vx, double vy, double half) {
    return fmt::format(
        R"("{}": {{"type": "rigid_body", "mass": {}, "inertia": {}, "position": {}, "angle": {}{}, "velocity": {},
                   "angular_velocity": {}, "markers": {{"a": {}, "b": {}}}}})",
        name, mass, spatial ? fmt::format("[{0}, {0}, {0}]", inertia) : fmt::format("{}", inertia), vector(x, y), angle,
        spatial ? R"(, "axis": [0, 0, 1])" : "", vector(vx, vy),
        spatial ? fmt::format("[0, 0, {}]", omega) : fmt::format("{}", omega), vector(-half, 0), vector(half, 0));
  };
  const auto hinge = [](const char* name, const char* between) {
    return fmt::format(R"("{}": {{"type": "revolute", "between": [{}], "radius": 0.01, "friction": {}}})", name,
                       between, coulomb(0.3));
  };
  return fmt::format(
      R"({{"trammel": 1, "space": "{}", "gravity": {},
           "bodies": {{{}, {}, {}, "base": {{"type": "moving_base", "markers": {{"d": {}}}}}}},
           "joints": {{{}, {}, {}, {}}}, "simulate": {{"until": 1}},
           "record": {{"every": 0.1, "observe": {{"x": "coupler.com.x", "y": "coupler.com.y", "load": "joints.d.load",
                                                 "T": "joints.q.friction"}}}}}})",
      spatial ? "spatial" : "planar", vector(0, -9.81),
      body("crank", 0.5, 0.00041666666666666675, -0.03441720101996192, 0.03626921937334098, crank, 10,
           -0.36269219373340983, -0.34417201019961924, 0.05),
      body("coupler", 0.8, 0.005999999999999999, 0.06051723978452534, 0.14848679460327313, coupler, 0.9974667266373399,
           -0.8011403453765815, -0.5593200616434395, 0.15),
      body("rocker", 0.6, 0.0031249999999999997, 0.24493444080448726, 0.11221757522993214, rocker, 3.9071255170573598,
           -0.4384481516431718, -0.21514805144382032, 0.125),
      vector(0.3, 0), hinge("o", R"("ground", "crank.a")"), hinge("p", R"("crank.b", "coupler.a")"),
      hinge("q", R"("coupler.b", "rocker.b")"), hinge("d", R"("base.d", "rocker.a")"));
}

TEST(FourBarInSpaceThatRubs, MovesAsInThePlane) {
  const Finished plane = run_text(four_bar(false)), space = run_text(four_bar(true));
  ASSERT_TRUE(plane.done()) << plane.report.reason;
  ASSERT_TRUE(space.done()) << space.report.reason;
  EXPECT_FALSE(plane.of_kind("reversal").empty());
  for (const char* name : {"x", "y"}) EXPECT_NEAR(space.end(name), plane.end(name), 1e-7) << name;
  for (const char* name : {"load", "T"}) EXPECT_NEAR(space.end(name), plane.end(name), 1e-6) << name;
}

}  // namespace
}  // namespace trammel::test
