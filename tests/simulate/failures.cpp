// Runs that cannot go on say when, in which step and why, and keep what they have.
#include <gmock/gmock.h>

#include "plugin/plugin_error.hpp"
#include "plugin/process/settings.hpp"

#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// sqrt(0.505 - t): not a number from then on.
const Overrides breaks_at_0505 = {
    {"forces.bad", R"json({"type": "load", "on": "ball.point", "force": {"x": "=sqrt(0.505-t)", "y": 0}})json"},
    {"bodies.ball.position", "[0, 100]"}};

class ForceThatIsNotANumber : public testing::TestWithParam<Method> {};

TEST_P(ForceThatIsNotANumber, EndsTheRunAndIsNamed) {
  Overrides overrides = breaks_at_0505;
  overrides.push_back({"integrator", GetParam().json});
  const Finished run = run_text(ball, overrides);
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("at t = 0.50"));
  EXPECT_THAT(run.report.reason, HasSubstr("step "));
  EXPECT_THAT(run.report.reason, HasSubstr("forces.bad (force load of "));
  EXPECT_THAT(run.report.reason, HasSubstr("load.so) gave numbers that are not finite in its \"wrench\""));
}

TEST_P(ForceThatIsNotANumber, LeavesTheRowsBefore) {
  Overrides overrides = breaks_at_0505;
  overrides.push_back({"integrator", GetParam().json});
  const Finished run = run_text(ball, overrides);
  ASSERT_EQ(run.series.at("t").size(), 51u);  // 0, 0.01 ... 0.5
  for (const double y : run.series.at("y")) EXPECT_TRUE(std::isfinite(y));
  EXPECT_EQ(run.result["status"], "failed");
}

std::vector<Method> all_methods() {
  std::vector<Method> methods = fixed_methods("1e-3");
  for (const Method& method : controlled_methods("1e-9")) methods.push_back(method);
  return methods;
}
INSTANTIATE_TEST_SUITE_P(With, ForceThatIsNotANumber, testing::ValuesIn(all_methods()), method_name);

class CorrectionThatChangesWhatIsNotItsOwn : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(CorrectionThatChangesWhatIsNotItsOwn, EndsTheRunAndIsNamed) {
  const auto& [how, said] = GetParam();
  for (const char* integrator : {"newmark", "runge_kutta_4", "hht_alpha"}) {
    std::string found;
    try {
      run_text(oscillator,
               {{"plugins", fmt::format(R"(["{}/tests/plugins/spoilt_correction.so"])", TRAMMEL_BUILD_DIR)},
                {"corrections", fmt::format(R"({{"position": {{"type": "spoilt_correction", "how": "{}"}}}})", how)},
                {"integrator", fmt::format(R"({{"type": "{}", "step": 1e-2}})", integrator)},
                {"contacts", "{}"}});
    } catch (const plugin::PluginError& e) {
      found = e.what();
    }
    EXPECT_THAT(found, HasSubstr("correction spoilt_correction (corrections.position): apply at t = 0.03 s, step 3: "));
    EXPECT_THAT(found, HasSubstr(said));
    EXPECT_STREQ(plugin::arithmetic_fault(), "");
  }
}

constexpr std::pair<const char*, const char*> changes[] = {
    {"q", "it left q with 1 numbers; expected 2"},
    {"v", "it left v with 5 numbers; expected 2"},
    {"a", "it left a with 0 numbers; expected 2"},
    {"lambda", "it left lambda with 100 numbers; expected 0"},
    {"t", "it changed the time to 1e+09 s; expected 0.03 s"},
    {"nan_in_q", "it left numbers that are not finite"},
    {"nan_in_v", "it left numbers that are not finite"},
    {"rounding", "numbers are no longer rounded to nearest"},
#if defined(__SSE2__)
    {"denormals", "numbers below 2.2e-308 (denormals) have become 0"},
#endif
#if defined(__GLIBC__)
    {"traps", "floating-point exceptions have become traps"},
#endif
};
INSTANTIATE_TEST_SUITE_P(Such, CorrectionThatChangesWhatIsNotItsOwn, testing::ValuesIn(changes),
                         [](const auto& change) { return std::string("As_") + change.param.first; });

TEST(DivergingRun, IsNotBlamedOnAComponent) {
  // h omega = 10: explicit Runge-Kutta multiplies by about 400 a step until the numbers end.
  const Finished run = run_text(
      oscillator,
      {{"forces.spring.stiffness", "1e4"}, {"integrator.step", "0.1"}, {"contacts", "{}"}, {"simulate.until", "1000"}});
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("at t = "));
  EXPECT_THAT(run.report.reason, testing::Not(HasSubstr("spring")));
  EXPECT_THAT(run.report.reason, HasSubstr("in the last trial the velocities change most in bodies.mass (100 %)"));
  EXPECT_THAT(run.report.reason, HasSubstr("; the steps before took 0.1 s"));
}

// The step that a run of 2 s can resolve, 16 units in the last place of t, is far below the steps of the extremes
// (1e-12 s).
TEST(TinyStep, ThatCannotBeResolvedIsRefusedWithTheSmallestSensibleOne) {
  for (const char* key : {"integrator.step", "integrator.contact_step"})
    for (const char* h : {"1e-300", "1e-22"}) {
      std::string said;
      try {
        run_file("beam_impact.json", {{key, h}});
      } catch (const scene::SceneError& e) {
        said = e.what();
      }
      EXPECT_THAT(said, HasSubstr(std::string(key) + ": found " + h + ", expected a step of at least 7.1e-15 s"));
    }
}

TEST(TinyStep, ThatCanBeResolvedIsTaken) {
  const Finished run = run_text(ball, {{"integrator.step", "1e-14"},
                                       {"contacts", "{}"},
                                       {"simulate.until", "1e-12"},
                                       {"record", R"({"every": 1e-12})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.result["counts"]["steps"], 100);
}

TEST(EventStorm, EndsTheRunWithAWayOut) {
  const Finished run = run_text(ball, {{"contacts.floor.restitution", "0.999"},
                                       {"simulate.event_limit", "5"},
                                       {"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-9}})"},
                                       {"bodies.ball.position", "[0, 1e-6]"}});
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("event storm at t = "));
  EXPECT_THAT(run.report.reason, HasSubstr("contacts.floor"));
  EXPECT_THAT(run.report.reason, HasSubstr("capture_speed"));
  EXPECT_THAT(run.report.reason, HasSubstr("; the last event is impact of contacts.floor at t = "));
  EXPECT_EQ(run.result["reason"], run.report.reason);
  EXPECT_FALSE(run.events.empty());  // what led to it is kept
}

TEST(StepOfAFixedMethod, ThatIsRefusedIsHalvedAndToldAsAWarning) {
  // Three iterations of Newton do not suffice at steps of 0.1 s; they do at a fraction of that.
  const Finished run =
      run_text(struck_bar, {{"integrator", R"({"type": "hht_alpha", "step": 0.1, "max_iterations": 3})"},
                            {"contacts", "{}"},
                            {"record", R"({"every": 0.1})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(run.result["counts"]["rejected"], 0);
  ASSERT_FALSE(run.result["warnings"].empty());
  EXPECT_THAT(run.result["warnings"][0].get<std::string>(),
              HasSubstr("was refused (Newton's iteration did not converge) and halved"));
}

std::string refusal(const std::string& scene, const Overrides& overrides) {
  try {
    run_text(scene, overrides);
  } catch (const scene::SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(InconsistentStart, IsRefusedWithByHowMuchAndTheNearestOne) {
  const std::string said = refusal(struck_bar, {{"bodies.bar.position", "[0.403, 0.304]"}});
  EXPECT_THAT(said, HasSubstr("off by 0.005 (m, rad) in position"));
  EXPECT_THAT(said, HasSubstr("the nearest consistent initial state moves bodies.bar by up to"));
  EXPECT_THAT(said, HasSubstr("\"consistent\": \"project\""));
}

TEST(InconsistentStart, IsRefusedForItsVelocityToo) {
  EXPECT_THAT(refusal(struck_bar, {{"bodies.bar.velocity", "[0.25, 0]"}}), HasSubstr("0.25 (m/s, rad/s) in velocity"));
}

// A rod's row is (|d|^2/L - L)/2, an angle's in space sin(delta); messages give |d| - L, delta and their rates.
TEST(InconsistentStart, IsReportedInMetresAndRadiansWhateverTheScaleOfTheRows) {
  const std::string rod = R"({"trammel": 1, "gravity": [0, 0],
    "bodies": {"bob": {"type": "point_mass", "mass": 1, "position": [2, 0], "velocity": [0.5, 0]}},
    "joints": {"rod": {"type": "distance", "between": ["ground", "bob.point"], "length": 1}},
    "integrator": {"type": "runge_kutta_4", "step": 0.01}, "simulate": {"until": 1}, "record": {"every": 1}})";
  EXPECT_THAT(refusal(rod, {}),
              HasSubstr("joints.rod: the initial state does not satisfy this joint: off by 1 (m, rad) in "
                        "position and 0.5 (m/s, rad/s) in velocity"));
  const std::string turned = R"({"trammel": 1, "space": "spatial", "gravity": [0, 0, 0],
    "bodies": {"door": {"type": "rigid_body", "mass": 1, "inertia": [1, 1, 1], "angular_velocity": [0, 0, 0.5]}},
    "joints": {"hinge": {"type": "revolute", "between": ["ground", "door.com"], "axis": [0, 0, 1], "angle": 0.75}},
    "integrator": {"type": "runge_kutta_4", "step": 0.01}, "simulate": {"until": 1}, "record": {"every": 1}})";
  EXPECT_THAT(refusal(turned, {}), HasSubstr("off by 0.75 (m, rad) in position and 0.5 (m/s, rad/s) in velocity"));
}

// A pendulum whose error per step is nobody's to correct: its rod grows.
TEST(OpenJoints, EndTheRunWithTheirNamesAndHowFarTheyAreApart) {
  const auto drifting = [](double until) {
    return run_text(fmt::format(R"({{"trammel": 1, "gravity": [0, -9.81],
      "bodies": {{"bob": {{"type": "point_mass", "mass": 1, "position": [1, 0]}}}},
      "joints": {{"rod": {{"type": "distance", "between": ["ground", "bob.point"], "length": 1}}}},
      "integrator": {{"type": "runge_kutta_4", "step": 0.1}},
      "simulate": {{"until": {}}}, "record": {{"every": 1}}}})",
                                until));
  };
  EXPECT_TRUE(drifting(2).done());
  const Finished run = drifting(1000);
  EXPECT_FALSE(run.done());
  EXPECT_THAT(run.report.reason, HasSubstr("joints have come apart: joints.rod by 0.1"));
  EXPECT_THAT(run.report.reason, testing::Not(HasSubstr("contradict")));  // there is a state nearby that holds it
}

TEST(InconsistentStart, IsMovedOntoTheJointsWhenAskedFor) {
  const Finished run = run_text(struck_bar, {{"bodies.bar.position", "[0.403, 0.304]"},
                                             {"bodies.bar.velocity", "[0.25, 0]"},
                                             {"initial", R"({"consistent": "project"})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(run.series.at("constraint_position").front(), 1e-14);
  EXPECT_LT(run.series.at("constraint_velocity").front(), 1e-14);
}

TEST(InconsistentStart, InsideAPlaneTellsTheDepthAndTheWayOut) {
  const std::string said = refusal(ball, {{"bodies.ball.position", "[0, -0.25]"}});
  EXPECT_THAT(said, HasSubstr("penetrates the plane by 0.25 m"));
  EXPECT_THAT(said, HasSubstr("the nearest initial state that touches moves bodies.ball by up to 0.25 (m, rad)"));
  EXPECT_THAT(said, HasSubstr("\"initial\": \"project\" takes it"));
}

TEST(InconsistentStart, InsideAPlaneIsMovedOutWhenAskedFor) {
  const Finished run = run_text(ball, {{"bodies.ball.position", "[0, -0.25]"}, {"initial", "project"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.series.at("y").front(), 0, 1e-15);  // round-off of 0.25
}

// Modes that bend weigh by what they store: all but a thousandth of the way is a turn about the hinge. The angle that
// puts a straight beam's tip onto the plane is 0.
TEST(InconsistentStart, OfABeamInsideAPlaneIsTurnedOutAndNotBent) {
  const Finished run =
      run_file("beam_impact.json", {{"bodies.beam.angle", "-0.1"}, {"initial", "project"}, {"simulate.until", "0"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.series.at("tip_y").front(), 0, 1e-10);
  EXPECT_NEAR(run.series.at("theta").front(), 0, 1e-4);
}

TEST(Energy, BeyondTheRangeOfNumbersIsReported) {
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"mass": {"type": "rigid_body", "mass": 1, "inertia": 1, "angular_velocity": 1e160}},
    "integrator": {"type": "runge_kutta_4", "step": 1e-3}, "simulate": {"until": 1}, "record": {"every": 1}})");
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("the energy left the range of numbers"));
  EXPECT_THAT(run.report.reason, Not(HasSubstr("nan")));
}

// Falls through less than the digits in which a scene is written are no motion, whatever the size.
TEST(Energy, OfAnOpeningWithinTheDigitsOfASceneIsNoReasonToWarn) {
  for (const double size : {1e-3, 1.0, 1e3, 1e6})
    for (const double gap : {1e-9, 1e-10}) {
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
        "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": {0}, "position": [0, {1:.17g}],
          "markers": {{"l": [-{2}, -{2}], "r": [{2}, -{2}]}}}}}},
        "contacts": {{
          "l": {{"type": "constraint_method", "between": ["block.l", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
          "r": {{"type": "constraint_method", "between": ["block.r", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
        "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-9}}}},
        "simulate": {{"until": {3}}}, "record": {{"every": {4}}}}})",
          size * size / 6, size * (0.5 + gap), size / 2, std::sqrt(size), std::sqrt(size) / 20));
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << size << " m, " << gap << ": " << run.result["warnings"];
    }
}

// Without gravity, a block that loads press on a plane has no speed; round-off of its rows is no energy.
TEST(Energy, OfWhatLoadsHoldAtRestIsNoReasonToWarn) {
  for (const double force : {1e-6, 1.0, 1e6})
    for (const char* press : {"-10", "-20*t", "-10-sin(5*t)"}) {
      const Finished run = run_text(fmt::format(
          R"({{"trammel": 1, "space": "planar", "parameters": {{"F": {0}}},
        "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": 0.01, "position": [0, 0.1],
          "markers": {{"l": [-0.1, -0.1], "r": [0.1, -0.1]}}}}}},
        "contacts": {{
          "l": {{"type": "constraint_method", "between": ["block.l", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
            "friction": {{"type": "coulomb", "static": 0.6, "kinetic": 0.5}}}},
          "r": {{"type": "constraint_method", "between": ["block.r", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
            "friction": {{"type": "coulomb", "static": 0.6, "kinetic": 0.5}}}}}},
        "forces": {{"push": {{"type": "load", "on": "block.com", "force": {{"x": "=3*F*t", "y": "=({1})*F"}}}}}},
        "simulate": {{"until": 1}}, "record": {{"every": 0.01}}}})",
          force, press));
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_TRUE(run.result["warnings"].empty()) << force << " N, " << press << ": " << run.result["warnings"];
    }
}

// A swing that the method damps is reported at any place: potential energies count from the origin.
TEST(Energy, ThatTheMethodTakesIsReportedWhereverTheSceneStands) {
  for (const double place : {0.0, 1e6, 1e8}) {
    const Finished run = run_text(fmt::format(
        R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
      "bodies": {{"mass": {{"type": "point_mass", "mass": 1, "position": [0, {:.17g}]}}}},
      "forces": {{"spring": {{"type": "spring_damper", "between": [{{"point": [0, {:.17g}]}}, "mass.point"],
        "stiffness": 100, "length": 1}}}},
      "integrator": {{"type": "hht_alpha", "alpha": -0.3, "step": 0.1}},
      "simulate": {{"until": 10}}, "record": {{"every": 1}}}})",
        place - 1, place));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_THAT(run.result["warnings"].dump(), HasSubstr("the method itself changed the energy")) << place;
  }
}

// A spring of omega = 10/s: steps beyond the method's limit make energy of nothing, however finite it is.
TEST(UnstableSteps, EndTheRunInsteadOfResults) {
  const auto spring = [](const char* integrator, double h) {
    return run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, 0],
      "bodies": {{"mass": {{"type": "point_mass", "mass": 1, "position": [0, 1.1]}}}},
      "forces": {{"spring": {{"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 100, "length": 1}}}},
      "integrator": {{"type": "{}", "step": {}}}, "simulate": {{"until": 40}}, "record": {{"every": 4}}}})",
                                integrator, h));
  };
  for (const char* method : {"runge_kutta_4", "dormand_prince", "dop853", "adams_baumgarte"}) {
    const Finished run = spring(method, 2);
    EXPECT_EQ(run.report.status, simulate::Status::failed) << method;
    EXPECT_THAT(run.report.reason, HasSubstr("diverged")) << method;
    EXPECT_TRUE(spring(method, 0.05).done()) << method;
  }
  for (const char* method : {"hht_alpha", "newmark", "generalized_alpha"})  // stable with any step
    EXPECT_TRUE(spring(method, 0.7).done()) << method;
}

// A mass that hangs in a light spring, and one on a spring too stiff for the least step.
TEST(StepsTooSmall, NameTheBodyThatMakesTheErrorTheStepsBeforeAndTheLastEvent) {
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"slow": {"type": "point_mass", "mass": 1, "position": [0, -1]},
               "fast": {"type": "point_mass", "mass": 1, "position": [1, -1.01]},
               "ball": {"type": "point_mass", "mass": 1, "position": [2, 0.05]}},
    "forces": {"soft": {"type": "spring_damper", "between": ["ground", "slow.point"], "stiffness": 10, "length": 1},
               "switched": {"type": "load", "on": "fast.point", "force": {"x": "=1e9*max(0, t-0.2)^0.1"}}},
    "contacts": {"floor": {"type": "constraint_method", "restitution": 0.5,
                           "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
    "integrator": {"type": "dop853", "step": {"tolerance": 1e-10, "min": 1e-4}},
    "simulate": {"until": 1}, "record": {"every": 0.1}})");
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason, HasSubstr("; the error of the last trial is that of bodies.fast (100 %)"));
  EXPECT_THAT(run.report.reason, HasSubstr("; the steps before took 0."));
  EXPECT_THAT(run.report.reason,
              testing::ContainsRegex("the last event is (impact|contact_open|lift) of contacts.floor at t = 0.1"));
}

TEST(ToleranceBelowRoundOff, IsAWarning) {
  const Finished run = run_text(ball, {{"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-18}})"}});
  EXPECT_TRUE(run.done()) << run.report.reason;
  EXPECT_THAT(run.result["warnings"].dump(), HasSubstr("integrator.step.tolerance: 1e-18 is unusual; it is usually"));
}

TEST(IterationThatFails, NamesTheBodyWithTheLargestResidual) {
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"falling": {"type": "point_mass", "mass": 1, "position": [0, 0]},
               "swinging": {"type": "point_mass", "mass": 1, "position": [0, -1], "velocity": [3, 0]}},
    "forces": {"spring": {"type": "spring_damper", "between": ["ground", "swinging.point"],
                          "stiffness": 1e4, "length": 1}},
    "integrator": {"type": "hht_alpha", "step": 0.1, "max_iterations": 1},
    "simulate": {"until": 1}, "record": {"every": 0.1}})");
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_THAT(run.report.reason,
              HasSubstr("; the residual of the last iterate is that of bodies.swinging (100 %), by energy"));
}

}  // namespace
}  // namespace trammel::test
