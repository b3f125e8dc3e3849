// Implicit steps of a stiff spring, whose tangent must be the same far from the origin and in any unit of length.
#include <string>

#include <gmock/gmock.h>

#include <fmt/format.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// A rod as a pendulum with a light mass on a stiff spring at its end. All lengths are in the unit; times stay.
std::string stiff_pendulum(double unit, double x) {
  const auto at = [&](double u) { return fmt::format("{:.17g}", (x + u) * unit); };
  const auto m = [&](double u) { return fmt::format("{:.17g}", u * unit); };
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {}],
    "bodies": {{"a": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "position": [{}, 0],
                       "markers": {{"t": [{}, 0], "e": [{}, 0]}}}},
               "b": {{"type": "point_mass", "mass": 1e-3, "position": [{}, {}]}}}},
    "joints": {{"j": {{"type": "revolute", "between": [{{"point": [{}, 0]}}, "a.t"]}}}},
    "forces": {{"s": {{"type": "spring_damper", "between": ["a.e", "b.point"], "stiffness": 1e9, "damping": 1,
                       "length": {}}}}},
    "integrator": {{"type": "hht_alpha", "step": 2e-4}}, "simulate": {{"until": 0.5}},
    "record": {{"every": 0.1, "observe": {{"x": "a.com.x", "y": "a.com.y"}}}}}})",
                     m(-9.81), unit * unit / 12, at(0.5), m(-0.5), m(0.5), at(1), m(-0.125), at(0), m(0.125));
}

TEST(ImplicitSteps, OfAStiffSpringAreTheSameInAnyUnitAndPlace) {
  const Finished here = run_text(stiff_pendulum(1, 0));
  ASSERT_TRUE(here.done()) << here.report.reason;
  const auto expect_same = [&](double unit, double x, double off) {
    const Finished there = run_text(stiff_pendulum(unit, x));
    ASSERT_TRUE(there.done()) << unit << ", " << x << ": " << there.report.reason;
    EXPECT_EQ(there.result["counts"]["rejected"], here.result["counts"]["rejected"]) << unit << ", " << x;
    EXPECT_NEAR(there.end("x") / unit - x, here.end("x"), off) << unit << ", " << x;
    EXPECT_NEAR(there.end("y") / unit, here.end("y"), off) << unit << ", " << x;
  };
  for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) expect_same(unit, 0, 1e-7);
  for (const double x : {1e1, 1e2, 1e3}) expect_same(1, x, 1e-7);
}

}  // namespace
}  // namespace trammel::test
