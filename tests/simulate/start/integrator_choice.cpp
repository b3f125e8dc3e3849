// The integrator of a scene that names none, and what a run that crawls says.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "diagnose/fastest_motion.hpp"
#include "diagnose/mass_ratio.hpp"
#include "simulate/start/setup.hpp"
#include "support/run_in_pieces.hpp"

namespace trammel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// Of two rods of 1 m from the horizontal: the upper one light, or the lower one.
std::string double_pendulum(double upper, double lower, const std::string& more = "") {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {{
      "u": {{"type": "rigid_body", "mass": {0}, "inertia": "={0}/12", "position": [0.5, 0], "markers": {{"h": [-0.5, 0], "e": [0.5, 0]}}}},
      "l": {{"type": "rigid_body", "mass": {1}, "inertia": "={1}/12", "position": [1.5, 0], "markers": {{"e": [-0.5, 0]}}}}}},
    "joints": {{"a": {{"type": "revolute", "between": ["ground", "u.h"]}}, "b": {{"type": "revolute", "between": ["u.e", "l.e"]}}}},
    {2} "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"u": "u.angle", "l": "l.angle"}}}}}})",
                     upper, lower, more);
}

// A mass on a stiff spring that swings as a pendulum does.
std::string spring_pendulum(double k, const std::string& more = "") {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {{"b": {{"type": "point_mass", "mass": 1, "position": [1, 0]}}}},
    "forces": {{"s": {{"type": "spring_damper", "between": ["ground", "b.point"], "stiffness": {}, "length": 1}}}},
    {} "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"x": "b.point.x", "y": "b.point.y"}}}}}})",
                     k, more);
}

std::string choice(const Finished& run) {
  return run.result["integrator_choice"];
}

// A pendulum of a rod with a light mass on a stiff spring at its end: damped steps. All lengths are in the unit, times
// stay.
std::string stiff_pendulum(double unit) {
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {g}],
    "bodies": {{"a": {{"type": "rigid_body", "mass": 1, "inertia": {i}, "position": [{half}, 0],
                       "markers": {{"t": [-{half}, 0], "e": [{half}, 0]}}}},
               "b": {{"type": "point_mass", "mass": 1e-3, "position": [{one}, -{tenth}]}}}},
    "joints": {{"j": {{"type": "revolute", "between": ["ground", "a.t"]}}}},
    "forces": {{"s": {{"type": "spring_damper", "between": ["a.e", "b.point"], "stiffness": 1e9, "damping": 1,
                       "length": {tenth}}}}},
    "simulate": {{"until": 1}}, "record": {{"every": 0.1, "observe": {{"x": "a.com.x", "y": "a.com.y"}}}}}})",
                     fmt::arg("g", -9.81 * unit), fmt::arg("i", unit * unit / 12), fmt::arg("half", unit / 2),
                     fmt::arg("one", unit), fmt::arg("tenth", unit / 10));
}

TEST(IntegratorChoice, HasTheToleranceOfTheScenesOwnUnit) {
  const Finished here = run_text(stiff_pendulum(1));
  ASSERT_TRUE(here.done()) << here.report.reason;
  ASSERT_THAT(choice(here), StartsWith("hht_alpha, tolerance 1e-07: "));
  for (const double unit : {1e-6, 1e-3}) {
    const Finished there = run_text(stiff_pendulum(unit));
    ASSERT_TRUE(there.done()) << there.report.reason;
    EXPECT_THAT(choice(there), StartsWith("hht_alpha, tolerance 1e-07: "));
    EXPECT_NEAR(there.end("x") / unit, here.end("x"), 1e-5) << unit;
    EXPECT_NEAR(there.end("y") / unit, here.end("y"), 1e-5) << unit;
  }
}

TEST(IntegratorChoice, IsDop853AsARule) {
  EXPECT_THAT(choice(run_text(spring_pendulum(100))), StartsWith("dop853, tolerance 1e-09: "));
  EXPECT_THAT(choice(run_text(double_pendulum(1, 1))), StartsWith("dop853, tolerance 1e-09: "));
  EXPECT_THAT(choice(run_text(double_pendulum(1, 1e6))), StartsWith("dop853, tolerance 1e-09: "));
  EXPECT_EQ(choice(run_text(spring_pendulum(100, R"("integrator": {"type": "runge_kutta_4", "step": 1e-2},)"))), "");
}

// A massless upper rod turns with the lower one's end: the ratio no longer plays a part, and the solution tends to that
// of 1e6.
TEST(IntegratorChoice, PutsRowsOnTheirPlaceWhereLightBodiesHoldHeavyOnes) {
  for (const double ratio : {1e8, 1e10, 1e12, 1e14}) {
    const Finished run = run_text(double_pendulum(1, ratio));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_THAT(choice(run), AllOf(StartsWith("dop853 with projected rows, tolerance 1e-09: "),
                                   HasSubstr(fmt::format("a mass ratio of {:.3g}", ratio))));
    EXPECT_LT(run.result["counts"]["steps"], 1000);
    // At rest from the horizontal only the lower rod's end of 1e-8 of the mass differs; both fall as one chain of known
    // start.
    const Finished other =
        run_text(double_pendulum(1, ratio), {{"integrator", R"({"type": "hht_alpha", "alpha": 0, "step": 1e-4})"}});
    ASSERT_TRUE(other.done()) << other.report.reason;
    EXPECT_NEAR(run.end("l"), other.end("l"), 1e-5)
        << ratio;  // of second order: (omega h)^2 with omega of 10 to 30 rad/s
    EXPECT_NEAR(run.end("u"), other.end("u"), 1e-5) << ratio;
  }
}

// Two hinged bodies that turn once in 1.5 hours: terms that pull rows back at 10 1/s would decide the steps. Without
// forces the turns are exact.
TEST(IntegratorChoice, LeavesSlowMotionsTheirLongSteps) {
  const std::string satellites = R"({"trammel": 1, "space": "planar", "gravity": [0, 0], "parameters": {"w": 1.16e-3},
    "bodies": {
      "a": {"type": "rigid_body", "mass": 500, "inertia": 400, "angular_velocity": "=w", "markers": {"h": [1, 0]}},
      "b": {"type": "rigid_body", "mass": 200, "inertia": 100, "position": [2, 0], "velocity": [0, "=2*w"],
            "angular_velocity": "=w", "markers": {"h": [-1, 0]}}},
    "joints": {"hinge": {"type": "revolute", "between": ["a.h", "b.h"]}},
    "simulate": {"until": 86400}, "record": {"every": 3600, "observe": {"turn": "a.com.angle"}}})";
  const Finished run = run_text(satellites);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_THAT(choice(run), AllOf(StartsWith("dop853 with projected rows, tolerance 1e-09: "), HasSubstr("86400 s")));
  EXPECT_LT(run.result["counts"]["steps"], 2000);
  EXPECT_NEAR(run.end("turn"), 1.16e-3 * 86400, 1e-5);  // as one body; 1e-9 of 100 rad a step, in some hundred steps
}

TEST(IntegratorChoice, DampsWhatIsTooFastToFollow) {
  const Finished exact = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"b": {"type": "point_mass", "mass": 1, "position": [1, 0]}},
    "joints": {"s": {"type": "distance", "between": ["ground", "b.point"], "length": 1}},
    "simulate": {"until": 1}, "record": {"every": 0.1, "observe": {"x": "b.point.x", "y": "b.point.y"}}})");
  for (const double k : {1e13, 1e14, 1e16}) {
    const Finished run = run_text(spring_pendulum(k));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_THAT(choice(run), AllOf(StartsWith("hht_alpha, tolerance 1e-07: "), HasSubstr("bodies.b swings at")));
    EXPECT_LT(run.result["counts"]["steps"], 10000);
    // The spring's stretch is m v^2/k; the rest is the method's error.
    EXPECT_NEAR(run.end("x"), exact.end("x"), 3e-5) << k;
    EXPECT_NEAR(run.end("y"), exact.end("y"), 3e-5) << k;
  }
}

// Steel takes a hundred times the steps of rubber, each of 326 coordinates: 13,381 of dop853, 1.9 ms each, for 0.3 s.
TEST(IntegratorChoice, CountsWhatAStepOfManyCoordinatesCosts) {
  std::string ball = read_text(TRAMMEL_SOURCE_DIR "/scenes/plate/ball.json");
  const std::size_t line = ball.find("  \"integrator\"");
  ball.erase(line, ball.find('\n', line) - line);
  const auto chosen = [&](const char* E) {
    const scene::Scene scene = scene::Scene::parse(ball, "ball.json", {{"bodies.plate.youngs_modulus", E}});
    return simulate::set_up(scene, registry()).choice;
  };
  EXPECT_THAT(chosen("2e7"), StartsWith("dop853, tolerance 1e-09: "));
  for (const char* steel : {"2.1e11", "7e12"})
    EXPECT_THAT(chosen(steel), AllOf(StartsWith("hht_alpha for many coordinates, tolerance 1e-05: "),
                                     HasSubstr("bodies.plate swings at")));
}

TEST(IntegratorChoice, IsKeptByAResumedRunWhoseEndHasMoved) {
  // 1 s of a spring of 1e11 N/m are 3e5 radians, 10 s are too many.
  const auto scene = [](const char* until) {
    return scene::Scene::parse(spring_pendulum(1e11), "test.json", {{"simulate.until", until}});
  };
  const auto chosen = [&](const char* until, const std::string& before) {
    return simulate::set_up(scene(until), registry(), simulate::Purpose::motion, nullptr, before).integrator_type;
  };
  EXPECT_EQ(chosen("1", ""), "dop853");
  EXPECT_EQ(chosen("10", ""), "hht_alpha");
  EXPECT_EQ(chosen("10", "dop853"), "dop853");
  EXPECT_EQ(chosen("1", "hht_alpha"), "hht_alpha");
}

simulate::FastestMotion fastest(const std::string& text) {
  const simulate::Setup setup = simulate::set_up(scene::Scene::parse(text, "test.json"), registry());
  model::AssembledSystem system(setup.model);
  return simulate::fastest_motion(system, setup.initial);
}

TEST(FastestMotion, IsTheFrequencyOfASpringAndTheRateOfADamper) {
  EXPECT_NEAR(fastest(spring_pendulum(1e6)).frequency, 1e3, 1e-6);
  const std::string damped = spring_pendulum(1e4, "");
  simulate::Setup setup =
      simulate::set_up(scene::Scene::parse(damped, "test.json", {{"forces.s.damping", "1e5"}}), registry());
  model::AssembledSystem system(setup.model);
  EXPECT_NEAR(simulate::fastest_motion(system, setup.initial).decay, 1e5, 1);  // c/m
}

// Of bodies that joints tie, through others too; the ground ties nothing.
TEST(MassRatio, IsThatOfBodiesTiedByJoints) {
  const auto ratio = [](const std::string& text) {
    const simulate::Setup setup = simulate::set_up(scene::Scene::parse(text, "test.json"), registry());
    return simulate::mass_ratio(*setup.model, setup.initial);
  };
  const simulate::MassRatio tied = ratio(double_pendulum(1, 1e10));
  EXPECT_EQ(tied.light_mass, 1);
  EXPECT_EQ(tied.heavy_mass, 1e10);
  EXPECT_TRUE(tied.is_large());
  const std::string apart = R"({"trammel": 1, "space": "planar", "bodies": {
      "a": {"type": "point_mass", "mass": 1, "position": [1, 0]}, "b": {"type": "point_mass", "mass": 1e12, "position": [0, 1]}},
    "joints": {"p": {"type": "distance", "between": ["ground", "a.point"], "length": 1},
               "q": {"type": "distance", "between": ["ground", "b.point"], "length": 1}}, "simulate": {"until": 1}})";
  EXPECT_FALSE(ratio(apart).is_large());
  EXPECT_FALSE(ratio(spring_pendulum(1e3)).is_large());
}

// Says within seconds what makes it crawl and what cures it, and goes on.
std::string said_while_it_crawls(const std::string& text) {
  const Folder folder;
  simulate::Interrupt stop;
  std::string said;
  simulate::RunOptions options;
  options.out = folder.path();
  options.interrupt = &stop;
  options.warn = [&](const std::string& warning) { said = warning, stop.request(); };
  const auto began = std::chrono::steady_clock::now();
  options.progress = [&](const simulate::Progress&) {
    if (std::chrono::steady_clock::now() - began > std::chrono::seconds(30)) stop.request();
  };
  const simulate::RunReport report = simulate::run(scene::Scene::parse(text, "test.json"), registry(), options);
  EXPECT_THAT(nlohmann::json::parse(report.result_json)["warnings"].dump(), HasSubstr(said.substr(0, 20)));
  return said;
}

TEST(SlowSteps, NameTheFastestMotionAndTheCure) {
  const std::string dop853 = R"("integrator": {"type": "dop853", "step": {"tolerance": 1e-9}},)";
  EXPECT_THAT(said_while_it_crawls(spring_pendulum(1e14, dop853)),
              AllOf(HasSubstr("bodies.b swings at 1e+07 rad/s"), HasSubstr("\"type\": \"hht_alpha\"")));
  const std::string swings =
      R"("integrator": {"type": "hht_alpha", "step": {"tolerance": 1e-7}}, "simulate": {"until": 100},)";
  std::string stretched = spring_pendulum(1e14, swings);
  stretched.replace(stretched.find("[1, 0]"), 6, "[1.000001, 0]");
  stretched.erase(stretched.rfind(R"("simulate")"), std::string(R"("simulate": {"until": 1},)").size());
  EXPECT_THAT(said_while_it_crawls(stretched),
              AllOf(HasSubstr("bodies.b swings at 1e+07 rad/s"), HasSubstr("\"damping\": stiffness / 1e+07")));
  // The chosen method is on the rows, but of 15 digits a ratio of 1e15 leaves none.
  EXPECT_THAT(said_while_it_crawls(double_pendulum(1, 1e15)),
              AllOf(HasSubstr("a mass ratio of 1e+15"), HasSubstr("looser tolerance"), HasSubstr("1e-06")));
  EXPECT_THAT(
      said_while_it_crawls(double_pendulum(1, 1e12, dop853)),
      AllOf(HasSubstr("bodies.u of 1 kg"), HasSubstr("a mass ratio of 1e+12"), HasSubstr("\"rows\": \"projected\"")));
}

}  // namespace
}  // namespace trammel::test
