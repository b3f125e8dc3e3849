// Springs so stiff that no step follows them: implicit methods take the steps of a rod in their place, and find its
// motion.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

// The members "bodies", "joints", "forces" of a scene, and the markers that the spring or rod ties at a distance. What
// is observed is body b.
struct Tied {
  const char* name;
  double gravity;
  const char *bodies, *joints, *forces;
  const char *from, *to;
  double length;
};
void PrintTo(const Tied& tied, std::ostream* out) {
  *out << tied.name;
}

const Tied of_pendulum = {"pendulum", 9.81, R"("b": {"type": "point_mass", "mass": 1, "position": [0.6, -0.8]})",
                          "",         "",   "ground",
                          "b.point",  1};
const Tied of_pair = {"pair",
                      0,
                      R"("a": {"type": "point_mass", "mass": 1, "position": [0, 0]},
                         "b": {"type": "point_mass", "mass": 1, "position": [1, 0], "velocity": [0, 1]})",
                      "",
                      "",
                      "a.point",
                      "b.point",
                      1};
const Tied of_chain = {
    "chain",
    9.81,
    R"("a": {"type": "point_mass", "mass": 1, "position": [1, 0]},
       "c": {"type": "point_mass", "mass": 1, "position": [2, 0]},
       "b": {"type": "point_mass", "mass": 1, "position": [3, 0]})",
    "",
    R"("s1": {"type": "spring_damper", "between": ["ground", "a.point"], "stiffness": 100, "length": 1},
       "s3": {"type": "spring_damper", "between": ["c.point", "b.point"], "stiffness": 100, "length": 1},)",
    "a.point",
    "c.point",
    1};
const Tied of_mechanism = {
    "mechanism",
    9.81,
    R"("u": {"type": "rigid_body", "mass": 1, "inertia": 0.08, "position": [0.5, 0],
             "markers": {"l": [-0.5, 0], "r": [0.5, 0]}},
       "l": {"type": "rigid_body", "mass": 1, "inertia": 0.08, "position": [1.5, 0],
             "markers": {"l": [-0.5, 0], "r": [0.5, 0]}},
       "b": {"type": "point_mass", "mass": 0.1, "position": [2.3, 0]})",
    R"("h": {"type": "revolute", "between": ["ground", "u.l"]}, "g": {"type": "revolute", "between": ["u.r", "l.l"]},)",
    "",
    "l.r",
    "b.point",
    0.3};

Finished run(const Tied& tied, const std::string& rod, const std::string& spring, const std::string& integrator) {
  const std::string joints = std::string(tied.joints) + rod, forces = std::string(tied.forces) + spring;
  const auto without_comma = [](const std::string& members) {
    return members.ends_with(',') ? members.substr(0, members.size() - 1) : members;
  };
  return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -{}], "bodies": {{{}}},
    "joints": {{{}}}, "forces": {{{}}}, "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"x": "b.point.x", "y": "b.point.y"}}}}}})",
                              tied.gravity, tied.bodies, without_comma(joints), without_comma(forces), integrator));
}
Finished with_rod(const Tied& tied, const std::string& integrator) {
  const std::string rod = fmt::format(R"("rod": {{"type": "distance", "between": ["{}", "{}"], "length": {}}})",
                                      tied.from, tied.to, tied.length);
  return run(tied, rod, "", integrator);
}
Finished with_spring(const Tied& tied, double k, const std::string& integrator) {
  const std::string spring =
      fmt::format(R"("spring": {{"type": "spring_damper", "between": ["{}", "{}"], "stiffness": {}, "length": {}}})",
                  tied.from, tied.to, k, tied.length);
  return run(tied, "", spring, integrator);
}

double apart(const Finished& a, const Finished& b) {
  return std::hypot(a.end("x") - b.end("x"), a.end("y") - b.end("y"));
}

class StiffSpring : public testing::TestWithParam<Tied> {};
INSTANTIATE_TEST_SUITE_P(InA, StiffSpring, testing::Values(of_pendulum, of_pair, of_chain, of_mechanism),
                         [](const auto& test) { return std::string(test.param.name); });

// Its stretch is below 1e-12 m. A spring that begins without its load swings by as much, and the steps follow it until
// its displacement in a step is below the tolerance: some of them more.
TEST_P(StiffSpring, TakesTheStepsOfARodAndItsMotion) {
  const std::string method = R"({"type": "hht_alpha", "step": {"tolerance": 1e-7}})";
  const Finished exact = with_rod(GetParam(), R"({"type": "dop853", "step": {"tolerance": 1e-10}})");
  const Finished rod = with_rod(GetParam(), method);
  ASSERT_TRUE(exact.done() && rod.done());
  const long long steps = rod.result["counts"]["steps"];
  for (const double k : {1e14, 1e15, 1e16}) {
    const Finished spring = with_spring(GetParam(), k, method);
    ASSERT_TRUE(spring.done()) << spring.report.reason;
    EXPECT_LT(spring.result["counts"]["steps"], 3 * steps + 100) << k;
    // 1e-7 in each of some hundred or thousand steps, of which the swing through the run makes ten times as much.
    EXPECT_LT(apart(spring, exact), std::max(3 * apart(rod, exact), 5e-5)) << k;
  }
}

// Newton's iteration ends with what is left across the spring as well: what is off is the method's own error, of the
// soft motions alone.
TEST_P(StiffSpring, WithConstantStepsDecidesNothing) {
  for (const char* method : {"hht_alpha", "generalized_alpha"}) {
    const std::string integrator = fmt::format(R"({{"type": "{}", "step": 1e-3}})", method);
    const Finished stiff = with_spring(GetParam(), 1e10, integrator);
    ASSERT_TRUE(stiff.done()) << stiff.report.reason;
    for (const double k : {1e12, 1e14}) {
      const Finished stiffer = with_spring(GetParam(), k, integrator);
      ASSERT_TRUE(stiffer.done()) << stiffer.report.reason;
      // The method's own error is 1e-5 to 1e-4; the springs differ by how the first steps, without their load, ring.
      EXPECT_LT(apart(stiffer, stiff), 1e-4) << method << ", " << k;
    }
  }
}

// A spring that really swings, by 1e-6 m and 10 m/s, is followed. The damper that the run names ends it.
TEST(SwingingSpring, IsEndedByTheDamperThatTheRunNames) {
  const double k = 1e14;
  const auto run = [&](double stretch) {
    return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
      "bodies": {{"b": {{"type": "point_mass", "mass": 1, "position": [{:.9g}, 0]}}}},
      "forces": {{"s": {{"type": "spring_damper", "between": ["ground", "b.point"], "stiffness": {}, "damping": {},
                        "length": 1}}}},
      "integrator": {{"type": "hht_alpha", "step": {{"tolerance": 1e-7}}}},
      "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"x": "b.point.x", "y": "b.point.y"}}}}}})",
                                1 + stretch, k, k / std::sqrt(k)));
  };
  const Finished swings = run(1e-6), rests = run(0);
  ASSERT_TRUE(swings.done() && rests.done());
  EXPECT_LT(swings.result["counts"]["steps"], 10000);
  EXPECT_LT(apart(swings, rests), 2e-5);
}

}  // namespace
}  // namespace trammel::test
