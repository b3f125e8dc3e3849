// States outside of a component's domain (OutsideDomain): an error of the scene at the start, with the component's
// line, and during a run its time; a step that only tries such a state is taken shorter. The plugin is never blamed.
#include <gmock/gmock.h>

#include <cmath>

#include <fmt/format.h>

#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Outside {
  const char* name;
  const char* space;
  std::string parts;  // bodies, joints, forces; the one at fault stands in line 3 of the text
  const char* path;
  const char* says;
};

std::string scene(const Outside& o,
                  const std::string& integrator = R"({"type": "dop853", "step": {"tolerance": 1e-9}})") {
  return fmt::format(
      "{{\"trammel\": 1, \"space\": \"{}\",\n {},\n \"integrator\": {}, \"simulate\": {{\"until\": 1}}}}", o.space,
      o.parts, integrator);
}

// Parts, from the start outside.
const Outside at_the_start[] = {
    {"Spring", "planar",
     "\"bodies\": {\"b\": {\"type\": \"point_mass\", \"mass\": 1}},\n"
     R"("forces": {"s": {"type": "spring_damper", "between": ["ground", "b.point"], "stiffness": 10, "length": 1}})",
     "forces.s", "its markers coincide"},
    {"SpringInSpaceBetweenBodies", "spatial",
     R"("bodies": {"a": {"type": "point_mass", "mass": 1, "position": [1e6, -3, 2]}, "b": {"type": "point_mass", "mass": 1, "position": [1e6, -3, 2]}},)"
     "\n"
     R"("forces": {"s": {"type": "spring_damper", "between": ["a.point", "b.point"], "stiffness": 10, "length": 1}})",
     "forces.s", "its markers coincide"},
    {"HingeSpring", "planar",
     "\"bodies\": {\"b\": {\"type\": \"point_mass\", \"mass\": 1}},\n"
     R"("forces": {"s": {"type": "hinge_spring", "between": ["ground", "b.point"], "stiffness": 10, "arms": 1}})",
     "forces.s", "its arms are folded"},
    {"LengthOfARod", "planar",
     "\"bodies\": {\"b\": {\"type\": \"point_mass\", \"mass\": 1, \"position\": [1, 0]}},\n"
     R"("joints": {"s": {"type": "distance", "between": ["ground", "b.point"], "length": "=-1-t"}})",
     "joints.s", "its length is -1"},
    {"AngleAboutATiltedAxis", "spatial",
     R"("bodies": {"b": {"type": "rigid_body", "mass": 1, "inertia": [1, 1, 1], "orientation": [1, 1, 0, 0]}},)"
     "\n"
     R"("forces": {"s": {"type": "torsional_spring", "between": ["ground", "b.com"], "stiffness": 10, "axis": [0, 0, 1]}})",
     "forces.s", "it measures an angle about an axis that its B has tilted by a right angle"},
};

class OutsideAtTheStart : public testing::TestWithParam<Outside> {};

TEST_P(OutsideAtTheStart, IsAnErrorOfTheSceneAtTheComponentsLine) {
  const auto expected = AllOf(HasSubstr(fmt::format("test.json:3:")), HasSubstr(GetParam().path),
                              HasSubstr("at t = 0 s " + std::string(GetParam().says)));
  const auto fault = [&](auto call) -> std::string {
    try {
      call();
    } catch (const scene::SceneError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_THAT(fault([] { simulate::validate(scene::Scene::parse(scene(GetParam()), "test.json"), registry()); }),
              expected);
  for (const Method& method : fixed_methods("1e-3"))
    EXPECT_THAT(fault([&] { run_text(scene(GetParam(), method.json)); }), expected) << method.name;
}
INSTANTIATE_TEST_SUITE_P(Of, OutsideAtTheStart, testing::ValuesIn(at_the_start),
                         [](const testing::TestParamInfo<Outside>& tested) { return std::string(tested.param.name); });

TEST(OutsideDuringTheRun, EndsItWithComponentAndTime) {
  // A rod that pulls a mass to its pivot, there at t = 0.5.
  const Outside rod = {"", "planar",
                       R"("bodies": {"b": {"type": "point_mass", "mass": 1, "position": [1, 0], "velocity": [-2, 0]}})"
                       ",\n"
                       R"("joints": {"s": {"type": "distance", "between": ["ground", "b.point"], "length": "=1-2*t"}})",
                       "", ""};
  for (const Method& method : fixed_methods("1e-2")) {
    const Finished run = run_text(scene(rod, method.json));
    EXPECT_EQ(run.report.status, simulate::Status::failed) << method.name;
    EXPECT_THAT(run.report.reason, AllOf(HasSubstr("joints.s: its length is "), HasSubstr("at t = 0."))) << method.name;
    EXPECT_NEAR(run.end("t"), 0.5, 0.02) << method.name;
    EXPECT_EQ(run.result["status"], "failed");
  }
}

TEST(OutsideDuringTheRun, IsPassedByShorterStepsWhereOnlyATrialWentThere) {
  // Arms of 1 m and 0.6 m that 18 J fold, less than the 5 pi^2/2 J of folding them flat: the end turns back before e =
  // 0.4 m, but long steps at 6 m/s try states beyond.
  const Outside arms = {
      "", "planar",
      R"("bodies": {"b": {"type": "point_mass", "mass": 1, "position": [1.5, 0], "velocity": [-6, 0]}})"
      ",\n"
      R"("forces": {"s": {"type": "hinge_spring", "between": ["ground", "b.point"], "stiffness": 5, "arms": [1, 0.6]}})",
      "", ""};
  int refused = 0;
  for (const char* step : {"0.16", "0.2", "0.22", "0.25", "0.28", "0.32"}) {
    const Finished run = run_text(scene(arms, fmt::format(R"({{"type": "runge_kutta_4", "step": {}}})", step)),
                                  {{"record", R"({"every": 1})"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    const std::string warning = "was refused (forces.s: its arms are folded onto each other";
    refused += run.result["warnings"].dump().find(warning) != std::string::npos;
  }
  EXPECT_GE(refused, 2);
  const Finished exact = run_text(scene(arms));
  EXPECT_TRUE(exact.done()) << exact.report.reason;
}

TEST(OutsideNothing, BarelyApartIsInside) {
  // As little as numbers hold: the direction is there, and the motion is that along it.
  for (const double y : {1e-300, 1e-160, 1e-30, 1e-8}) {
    const Outside spring = {
        "", "planar",
        fmt::format(
            R"("bodies": {{"b": {{"type": "point_mass", "mass": 1, "position": [0, {}]}}}},)"
            "\n"
            R"("forces": {{"s": {{"type": "spring_damper", "between": ["ground", "b.point"], "stiffness": 10, "length": 1}}}},
        "record": {{"observe": {{"y": "b.point.y"}}}})",
            y),
        "", ""};
    const Finished run = run_text(scene(spring));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.end("y"), 1 - std::cos(std::sqrt(10.0)), 1e-7) << y;  // 100 times the tolerance; y plays no part
  }
}

}  // namespace
}  // namespace trammel::test
