// Every joule has a cause: what the ledger says against closed forms, and nothing left over but the method's error.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

double drift(const Finished& run) {
  return run.result["energy_drift"];
}

// Of a mass of 1 kg at 2 m/s, x(t) = x0 + ..., without gravity.
const std::string puck = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"mass": {"type": "point_mass", "mass": 1, "position": [1, 0], "velocity": [2, 0]}},
  "integrator": {"type": "runge_kutta_4", "step": 1e-3},
  "simulate": {"until": 1},
  "record": {"every": 0.1}
})";

TEST(EnergyLedger, GivesADamperWhatItTook) {
  // v' = -c v: dissipated 2 J (1 - exp(-2 c t)).
  const Finished run = run_text(
      puck,
      {{"forces.damper",
        R"({"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 0, "damping": 3, "length": 1})"}});
  EXPECT_NEAR(run.result["energy_dissipated"]["dampers"], 2 * (1 - std::exp(-6.0)), 1e-11);  // Simpson and RK4: (c h)^4
  EXPECT_NEAR(drift(run), 0, 1e-11);
}

// E(t) = E(0) + supplied(t) - dissipated(t) at each record: of fixed steps at their ends, of controlled ones within
// them.
TEST(EnergyLedger, ClosesAtEveryRecordOfTheSeries) {
  const char* spring_and_push = R"json({
    "spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 40, "damping": 0.6, "length": 1},
    "push": {"type": "load", "on": "mass.point", "force": {"x": "=3*cos(5*t)"}}})json";
  // The quintic within a step errs by h^6/720 of the work's sixth derivative: P omega^5 = 6 W (11 rad/s)^5, so 1e-9 J
  // at 0.01 s. The interpolation of Dormand and Prince is of order 4 and errs by more.
  const std::pair<const char*, double> methods[] = {
      {R"({"type": "runge_kutta_4", "step": 1e-3})", 1e-9},  // Simpson and RK4: (omega h)^4
      {R"({"type": "dormand_prince", "step": {"tolerance": 1e-9, "max": 0.01}})", 1e-8},
      {R"({"type": "dop853", "step": {"tolerance": 1e-9, "max": 0.01}})", 2e-9}};
  for (const auto& [integrator, tolerance] : methods) {
    const Finished run =
        run_text(puck, {{"forces", spring_and_push}, {"record.every", "0.013"}, {"integrator", integrator}});
    const auto &total = run.series.at("energy_total"), &supplied = run.series.at("energy_supplied"),
               &dissipated = run.series.at("energy_dissipated");
    ASSERT_GT(total.size(), 70u);
    EXPECT_GT(dissipated.back(), 0.1);
    for (std::size_t i = 0; i < total.size(); ++i)
      EXPECT_NEAR(total[i], total[0] + supplied[i] - dissipated[i], tolerance) << integrator << ", row " << i;
  }
}

// A block that friction holds until t_0 slides on a floor into which it is pressed more and more: its force along the
// floor exceeds friction by k (t - t_0), so v = k (t - t_0)^2 / (2 m), and friction takes mu N v. A long step begins
// there: no cubic is a power of t - t_0 as high as this work.
TEST(EnergyLedger, FollowsFrictionThatBeginsAtRestAtEveryRecordOfALongStep) {
  const double m = 2, mu = 0.3, pressed = 12, along = 9, k = along - mu * pressed;  // [kg], [1], [N/s] twice
  const double weight = 10 * m, t_0 = mu * weight / k;
  const Finished run = run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {{"block": {{"type": "point_mass", "mass": {}, "position": [0, 0]}}}},
  "forces": {{"hand": {{"type": "load", "on": "block.point", "force": {{"x": "={}*t", "y": "=-{}*t"}}}}}},
  "contacts": {{"foot": {{"type": "constraint_method", "restitution": 0,
                        "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                        "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
  "simulate": {{"until": 2}}, "record": {{"every": 0.01}}}})",
                                            m, along, pressed, mu, mu));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto &t = run.series.at("t"), &dissipated = run.series.at("energy_dissipated"),
             &supplied = run.series.at("energy_supplied");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double s = std::max(0.0, t[i] - t_0), N = weight + pressed * t_0;  // at t_0
    const double taken = mu * k / (2 * m) * (N * s * s * s / 3 + pressed * s * s * s * s / 4);
    const double given = along * k / (2 * m) * (t_0 * s * s * s / 3 + s * s * s * s / 4);
    EXPECT_NEAR(dissipated[i], taken, 1e-7 * taken + 1e-9) << t[i];  // t_0 is found to 1e-8 of the bound
    EXPECT_NEAR(supplied[i], given, 1e-7 * given + 1e-9) << t[i];
  }
  EXPECT_GT(dissipated.back(), 1);
}

TEST(EnergyLedger, GivesADamperWhatItTookWithTheOrderOfTheMethod) {
  const auto error = [](const char* type, const char* step) {
    const Finished run = run_text(
        puck,
        {{"forces.damper",
          R"({"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 0, "damping": 3, "length": 1})"},
         {"integrator.type", type},
         {"integrator.step", step}});
    return std::abs(run.result["energy_dissipated"]["dampers"].get<double>() - 2 * (1 - std::exp(-6.0)));
  };
  const auto order = [&](const char* type) { return std::log2(error(type, "0.1") / error(type, "0.05")); };
  EXPECT_GT(order("runge_kutta_4"), 3.8);
  EXPECT_GT(order("dormand_prince"), 4.8);
  EXPECT_GT(order("dop853"), 6.8);  // of its dense output
}

TEST(EnergyLedger, GivesADamperWhatManySwingsOfAStepLose) {
  // x'' = -1e4 x - 0.2 x' from x = 1: a step of exponential collocation holds several of its swings.
  const Finished run = run_text(
      puck,
      {{"bodies.mass.velocity", "[0, 0]"},
       {"forces.spring",
        R"({"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 1e4, "damping": 0.2, "length": 0})"},
       {"integrator", R"({"type": "exponential_collocation", "step": {"tolerance": 1e-8}})"}});
  const double energy = run.result["energy_end"]["total"];
  // Lobatto's rule of order 12 over a step of some swings.
  EXPECT_NEAR(run.result["energy_dissipated"]["dampers"], 5000 - energy, 1e-5 * 5000);
}

TEST(EnergyLedger, GivesALoadWhatItSupplied) {
  // v = 2 + sin(5 t): 1/2 v^2 - 2.
  const Finished run = run_text(
      puck,
      {{"forces.load", R"json({"type": "load", "on": "mass.point", "force": {"x": "=5*cos(5*t)", "y": 0}})json"}});
  const double v = 2 + std::sin(5.0);
  EXPECT_NEAR(run.result["energy_supplied"]["drives"], v * v / 2 - 2, 1e-11);
  EXPECT_NEAR(drift(run), 0, 1e-11);
}

TEST(EnergyLedger, GivesImpactsWhatTheyTook) {
  const Finished run = run_text(ball);
  double lost = 0;
  for (const Event& impact : run.of_kind("impact")) lost += impact.detail.at("energy_lost");
  EXPECT_DOUBLE_EQ(run.result["energy_dissipated"]["impact_total"], lost);
  EXPECT_DOUBLE_EQ(run.result["energy_dissipated"]["impact"]["floor"], lost);
  EXPECT_NEAR(lost, 1, 1e-11);  // all of m g h: the ball rests
  EXPECT_NEAR(drift(run), 0, 1e-12);
}

TEST(EnergyLedger, GivesAMovingJointItsWork) {
  // A crank of inertia 1/3 about its axle, turned at 10 rad/s: the drive lifts and lowers its weight.
  const Finished run = run_file("tour/05_slider_crank.json");
  EXPECT_NEAR(run.result["energy_supplied"]["constraints"],
              run.result["energy_end"]["total"].get<double>() - run.result["energy_start"].get<double>(), 1e-4);
  EXPECT_NE(run.result["energy_supplied"]["constraints"], 0);
  EXPECT_EQ(run.result["energy_supplied"]["drives"], 0);
}

TEST(EnergyLedger, ClosesForAllCausesAtOnceWithTheOrderOfTheMethod) {
  const auto left_over = [](const std::string& type, const char* step) {
    return std::abs(drift(run_text(struck_bar, {{"integrator.type", type}, {"integrator.step", step}})));
  };
  // Explicit methods let a closed row drift; what they lose with it is of the order of the method as well.
  EXPECT_LT(left_over("runge_kutta_4", "1e-3"), 1e-9);
  EXPECT_LT(left_over("dop853", "1e-3"), 1e-9);
  EXPECT_NEAR(left_over("newmark", "1e-3") / left_over("newmark", "5e-4"), 4, 1);
}

TEST(EnergyLedger, OfAConservativeMotionHasNothingInIt) {
  const Finished run = run_text(oscillator, {{"contacts", "{}"}, {"bodies.mass.position", "[0, 1.5]"}});
  EXPECT_EQ(run.result["energy_supplied"]["total"], 0);
  EXPECT_EQ(run.result["energy_dissipated"]["dampers"], 0);
  EXPECT_NEAR(drift(run), 0, 2e-12);  // RK4 damps by (h omega)^6 / 72 of the 0.125 J a step, 1000 steps
}

// A ladder whose foot rubs on the floor and whose head slides along the wall.
std::string ladder(const char* method) {
  return fmt::format(R"json({{
    "trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {{"ladder": {{"type": "rigid_body", "mass": 1, "inertia": "=1/3", "angle": 2, "angular_velocity": 0,
                           "position": ["=-cos(2)", "=sin(2)"], "markers": {{"foot": [-1, 0], "head": [1, 0]}}}}}},
    "contacts": {{
      "floor": {{"type": "constraint_method", "friction": {{"type": "coulomb", "static": 0.1, "kinetic": 0.1}},
                "between": ["ladder.foot", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
      "wall": {{"type": "constraint_method", "between": ["ladder.head", {{"plane": {{"point": [0, 0], "normal": [1, 0]}}}}]}}}},
    "integrator": {{"type": "{}", "step": 0.02}},
    "simulate": {{"until": 0.4}}, "record": {{"every": 0.02, "observe": {{
      "angle": "ladder.com.angle", "floor": "contacts.floor.force", "wall": "contacts.wall.force",
      "off_floor": "ladder.foot.vy", "off_wall": "ladder.head.vx"}}}}}})json",
                     method);
}

// What rows do within steps, by the motion between two states on them, is nothing.
TEST(EnergyLedger, GivesRowsOfContactsNothingWhereTheMethodHoldsThem) {
  for (const char* method : {"newmark", "hht_alpha", "generalized_alpha"}) {
    const Finished run = run_text(ladder(method));
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_GT(run.end("angle"), 2.05) << method;
    EXPECT_GT(run.result["energy_dissipated"]["friction_total"], 0.01) << method;
    EXPECT_NEAR(run.result["energy_supplied"]["constraints"], 0, 1e-10) << method;
  }
}

// A method that lets rows drift does work against them: the force times the rate at the ends of steps.
TEST(EnergyLedger, GivesRowsOfContactsTheWorkOfTheirDrift) {
  const Finished run = run_text(ladder("runge_kutta_4"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  double work = 0;
  for (const auto& [force, rate] : {std::pair("floor", "off_floor"), {"wall", "off_wall"}}) {
    const std::vector<double>&N = run.series.at(force), &r = run.series.at(rate);
    ASSERT_EQ(N.size(), 21u);
    for (std::size_t i = 0; i + 1 < N.size(); ++i) work += 0.02 / 2 * (N[i] * r[i] + N[i + 1] * r[i + 1]);
  }
  EXPECT_GT(std::abs(work), 1e-9);
  EXPECT_NEAR(run.result["energy_supplied"]["constraints"], work, 0.02 * std::abs(work));  // trapezoidal rule
}

// The round-off of a hinge that stands still has a power, which was integrated where the energy at the start, 0 J here,
// was all it could be measured by: an evaluation more each step.
TEST(EnergyLedger, OfAMotionFromZeroEnergyCostsNoEvaluation) {
  const Finished run = run_file("tour/01_pendulum.json");
  const nlohmann::json& counts = run.result["counts"];
  EXPECT_EQ(run.result["energy_start"], 0);
  EXPECT_LT(counts["residual_evaluations"].get<double>() - counts["newton_iterations"].get<double>(),
            0.01 * counts["steps"].get<double>());
}

// A mass beside a point that sways by 0.1 sin(5 t), tied to it or struck by it.
const std::string swaying = R"json({
  "trammel": 1, "gravity": [0, 0],
  "bodies": {"base": {"type": "moving_base", "x": "=0.1*sin(5*t)"},
             "mass": {"type": "point_mass", "mass": 1, "position": [1, 0]}},
  "integrator": {"type": "dop853", "step": 1e-3},
  "simulate": {"until": 2}, "record": {"every": 0.5}
})json";

// On either side of the spring.
TEST(EnergyLedger, GivesAPointMovedByALawTheWorkItDoesThroughASpring) {
  for (const char* ends : {R"(["base.origin", "mass.point"])", R"(["mass.point", "base.origin"])"}) {
    SCOPED_TRACE(ends);
    const Finished run =
        run_text(swaying, {{"forces.spring", R"({"type": "spring_damper", "stiffness": 9, "damping": 0.1,
                                                                 "length": 1, "between": )" +
                                                 std::string(ends) + "}"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double supplied = run.result["energy_supplied"]["moving_markers"];
    EXPECT_GT(std::abs(supplied), 1e-3);
    EXPECT_NEAR(drift(run), 0, 1e-11);  // Simpson's rule: (h omega)^4 / 2880 of a few watts
  }
}

TEST(EnergyLedger, GivesAPointMovedByALawTheWorkItDoesThroughAContact) {
  const Finished run = run_text(
      swaying, {{"bodies.mass.position", "[0.05, 0]"},
                {"bodies.mass.velocity", "[0, 0.3]"},
                {"contacts.bat", R"({"type": "continuous_force", "stiffness": 1e4, "exponent": 1, "damping": "none",
                    "between": ["mass.point", {"plane": {"point": [0, 0], "normal": [1, 0], "on": "base.origin"}}],
                    "friction": {"type": "coulomb", "static": 0.3, "kinetic": 0.2}})"},
                {"integrator", R"({"type": "dop853", "step": 1e-3, "contact_step": 1e-5})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_FALSE(run.of_kind("contact_close").empty());
  EXPECT_GT(run.result["energy_supplied"]["moving_markers"], 1e-3);
  EXPECT_GT(run.result["energy_dissipated"]["friction"]["bat"], 1e-4);
  EXPECT_NEAR(drift(run), 0, 1e-9);
}

}  // namespace
}  // namespace trammel::test
