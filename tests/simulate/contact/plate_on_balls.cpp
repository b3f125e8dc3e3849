// A plate on balls that roll on a floor, in space.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// A load that grows pushes the plate. Balls begin to slide so slowly that their slip has no direction for a long time,
// which has their modes decided again and again. The slip of ball 1 ends at 0.336 s: from there on its friction must
// not act in the direction that it had.
TEST(PlateOnBalls, HasFrictionThatOpposesTheSlipsAfterTheyReverse) {
  constexpr double R = 0.05;
  constexpr double places[4][2] = {{0.18, 0.02}, {0.22, -0.11}, {-0.14, 0.2}, {0.23, 0.15}};
  const std::string friction = R"("friction": {"type": "coulomb", "static": 0.25, "kinetic": 0.25})";
  std::string bodies, contacts;
  for (int i = 0; i < 4; ++i) {
    bodies += fmt::format(R"(, "ball{}": {{"type": "rigid_body", "mass": 0.5, "inertia": [5e-4, 5e-4, 5e-4],
                              "position": [{}, {}, {}]}})",
                          i, places[i][0], places[i][1], R);
    for (const bool floor : {true, false})
      contacts += fmt::format(
          R"({}"{}{}": {{"type": "constraint_method", "restitution": 0, "radius": {}, {},
                         "between": ["ball{}.com", {{"plane": {{"point": [0, 0, 0], {}}}}}]}})",
          contacts.empty() ? "" : ", ", floor ? "floor" : "plate", i, R, friction, i,
          floor ? R"("normal": [0, 0, 1])" : R"("normal": [0, 0, -1], "on": "plate.bottom")");
  }
  const Finished run = run_text(fmt::format(
      R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81], "bodies": {{
             "plate": {{"type": "rigid_body", "mass": 12, "inertia": [0.3616, 0.3616, 0.72], "position": [0, 0, 0.12],
                        "markers": {{"bottom": [0, 0, -0.02], "pushed": [0.1, 0, 0]}}}}{}}},
           "contacts": {{{}}},
           "forces": {{"push": {{"type": "load", "on": "plate.pushed",
                                 "force": {{"x": "=131.37552*t", "y": "=-32.13756*t", "z": 0}}}}}},
           "simulate": {{"until": 0.345}},
           "record": {{"every": 0.001, "observe": {{"x": "plate.com.x"}}}}}})",
      bodies, contacts));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_TRUE(run.result["warnings"].empty()) << run.result["warnings"].dump();
}

}  // namespace
}  // namespace trammel::test
