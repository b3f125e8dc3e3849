// Set-valued friction against closed forms: a block on an incline, on a shaken table, rods and rocking blocks, with
// rigid and compliant contacts. Reference values: tests/data/free_standing.json, "unit_cases".
#include <cmath>
#include <numbers>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;
using std::numbers::pi;

const json& reference() {
  static const json data = json::parse(read_text(TRAMMEL_SOURCE_DIR "/tests/data/free_standing.json"));
  return data["unit_cases"];
}

double number(const json& text) {
  return text.is_number() ? text.get<double>() : std::stod(text.get<std::string>());
}

// A block (a point) on a plane whose axes are the world's; gravity is tilted by phi. x runs up the incline.
std::string block(double phi, double mu_0, double mu, double v, const std::string& law,
                  const std::string& integrator = R"({"type": "dop853", "step": {"tolerance": 1e-12}})") {
  return fmt::format(R"({{
    "trammel": 1, "gravity": [{:.17g}, {:.17g}],
    "bodies": {{"block": {{"type": "point_mass", "mass": 1, "velocity": [{:.17g}, 0], "position": [0, {}]}}}},
    "contacts": {{"foot": {{{}, "between": ["block.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                           "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}}}}}},
    "integrator": {}, "simulate": {{"until": 1}},
    "record": {{"every": 0.1, "observe": {{"x": "block.point.x", "vx": "block.point.vx", "N": "contacts.foot.force",
                                          "T": "contacts.foot.friction"}}}}
  }})",
                     -9.81 * std::sin(phi), -9.81 * std::cos(phi), v,
                     law.find("continuous") != std::string::npos
                         ? fmt::format("{:.17g}", -std::pow(9.81 * std::cos(phi) / 1e6, 1 / 1.5))
                         : "0",
                     law, mu_0, mu, integrator);
}

const std::string rigid = R"("type": "constraint_method")";
const std::string compliant = R"("type": "continuous_force", "stiffness": 1e6, "damping": "none")";

class Incline : public testing::TestWithParam<std::string> {};

TEST_P(Incline, SticksBelowTheFrictionAngleAndSlidesAbove) {
  for (const json& row : reference()["incline"]["rows"]) {
    const double mu = row["case"] == "mu0=mu=0.6" ? 0.6 : 0.48, phi = number(row["phi_deg"]) * pi / 180;
    const Finished run = run_text(block(phi, 0.6, mu, 0, GetParam()));
    ASSERT_TRUE(run.done()) << run.report.reason;
    // The angle has 13 digits, g sin(phi) - mu g cos(phi) too few of them left at the friction angle.
    EXPECT_NEAR(run.end("x"), -number(row["distance_after_1s"]), 1e-11) << row.dump();
    EXPECT_NEAR(run.end("T") / 9.81, number(row["friction_over_mg"]), 1e-9) << row.dump();
    EXPECT_EQ(run.of_kind(row["state"]).size(), 1u) << row.dump();  // "stick" or "slip", once, at t = 0
    EXPECT_EQ(run.of_kind(row["state"] == "stick" ? "slip" : "stick").size(), 0u) << row.dump();
  }
}

TEST_P(Incline, BlockLaunchedUpwardsStaysWhereItStops) {
  const json& row = reference()["incline"]["upward_launch_then_stay"];
  const Finished run = run_text(block(20 * pi / 180, 0.6, 0.48, 2, GetParam()));
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("stick").size(), 1u);
  EXPECT_NEAR(run.of_kind("stick")[0].t, number(row["time"]), 1e-11);
  EXPECT_NEAR(run.end("x"), number(row["distance"]), 1e-11);
  EXPECT_NEAR(run.end("vx"), 0, 1e-14);
  const double lost = 0.48 * 9.81 * std::cos(20 * pi / 180) * number(row["distance"]);
  EXPECT_NEAR(run.result["energy_dissipated"]["friction"]["foot"], lost, 1e-9);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9);
}

TEST_P(Incline, BlockLaunchedUpwardsOnASteepOneSlidesBackWithoutSticking) {
  const json& row = reference()["incline"]["upward_launch_then_slide_back"];
  const Finished run = run_text(block(35 * pi / 180, 0.6, 0.48, 2, GetParam()),
                                {{"simulate.until", row["time_back_to_start"].get<std::string>()}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("stick").size(), 0u);
  ASSERT_EQ(run.of_kind("reversal").size(), 1u);
  EXPECT_NEAR(run.of_kind("reversal")[0].t, number(row["time_up"]), 1e-11);
  EXPECT_NEAR(run.end("x"), 0, 1e-11);
  EXPECT_NEAR(run.end("vx"), -number(row["speed_at_start"]), 1e-11);
}

TEST_P(Incline, StoppingTimesAndDistancesAreTheClosedForms) {
  for (const json& row : reference()["stopping"]) {
    const double mu = number(row["mu"]);
    const Finished run = run_text(block(0, mu, mu, number(row["v0"]), GetParam()), {{"simulate.until", "1.1"}});
    ASSERT_EQ(run.of_kind("stick").size(), 1u) << run.report.reason;
    EXPECT_NEAR(run.of_kind("stick")[0].t, number(row["time"]), 1e-11);
    EXPECT_NEAR(run.end("x"), number(row["distance"]), 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(Contacts, Incline, testing::Values(rigid, compliant),
                         [](const auto& law) { return law.param == rigid ? "rigid" : "compliant"; });

// As one stops the other one slides slowly, and goes on.
TEST(Friction, StopsEachOfTwoBlocksAtItsOwnTime) {
  const char* const floor =
      R"("friction": {"type": "coulomb", "static": 0.2, "kinetic": 0.2}, "type": "constraint_method",
                               "between": [)";
  const Finished run = run_text(fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {{"a": {{"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [2, 0]}},
               "b": {{"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [2.002, 0]}}}},
    "contacts": {{"a": {{{0} "a.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}},
                 "b": {{{0} "b.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}}}},
    "integrator": {{"type": "dop853", "step": 0.01}}, "simulate": {{"until": 1.5}}, "record": {{"every": 0.5}}}})",
                                            floor));
  const std::vector<Event> stops = run.of_kind("stick");
  ASSERT_EQ(stops.size(), 2u) << run.report.reason;
  EXPECT_NEAR(stops[0].t, 1, 1e-11);
  EXPECT_NEAR(stops[1].t, 1.001, 1e-11);
}

class EveryIntegrator : public testing::TestWithParam<const char*> {};

TEST_P(EveryIntegrator, StopsTheBlockOnTheIncline) {
  for (const std::string& law : {rigid, compliant}) {
    const json& row = reference()["incline"]["upward_launch_then_stay"];
    const Finished run =
        run_text(block(20 * pi / 180, 0.6, 0.48, 2, law, fmt::format(R"({{"type": "{}", "step": 1e-3}})", GetParam())));
    ASSERT_TRUE(run.done()) << law << run.report.reason;
    ASSERT_EQ(run.of_kind("stick").size(), 1u) << law;
    EXPECT_NEAR(run.of_kind("stick")[0].t, number(row["time"]), 1e-9)
        << law;  // polynomial motion: exact up to the iteration
    EXPECT_NEAR(run.end("x"), number(row["distance"]), 1e-9) << law;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryIntegrator,
                         testing::Values("hht_alpha", "newmark", "generalized_alpha", "adams_baumgarte",
                                         "runge_kutta_4", "dormand_prince", "dop853"));

// The table's motion X sin(w t) as the force m X w^2 sin(w t) on the block, in the table's frame.
Finished shaken(const json& row, const std::string& law) {
  const double X = number(row["X"]), w = number(row["omega"]);
  return run_text(block(0, number(row["mu0"]), number(row["mu"]), 0, law),
                  {{"forces.shake", fmt::format(R"json({{"type": "load", "on": "block.point",
                                                    "force": {{"x": "={:.17g}*sin({:.17g}*t)", "y": 0}}}})json",
                                                X * w * w, w)},
                   {"simulate.until", "16"},
                   {"record.every", "2"}});
}

TEST(ShakenTable, MovesTheBlockInItsThreeRegimes) {
  for (const json& row : reference()["shaken_table"]["rows"]) {
    const Finished run = shaken(row, rigid);
    ASSERT_TRUE(run.done()) << run.report.reason;
    for (int k = 1; k <= 8; ++k)
      // Where sticking begins slowly (1.001 x the threshold) the slip speed is 1e-6 and its zero less sharp.
      EXPECT_NEAR(run.series.at("x")[k], number(row["rel_at_periods"][k - 1]), 1e-9) << row["label"];
    std::vector<Event> changes;
    for (const Event& event : run.events)
      if (event.t > 0 && event.kind != "contact_close") changes.push_back(event);
    const json& expected = row["events"];
    ASSERT_GE(changes.size(), std::min<std::size_t>(expected.size(), 10)) << row["label"];
    for (std::size_t i = 0; i < std::min<std::size_t>(expected.size(), 10); ++i) {
      const std::string kind = expected[i][0];
      EXPECT_EQ(changes[i].kind, kind == "stick->slip"   ? "slip"
                                 : kind == "slip->stick" ? "stick"
                                                         : "reversal")
          << row["label"];
      EXPECT_NEAR(changes[i].t, number(expected[i][1]), 1e-8) << row["label"];
    }
  }
}

TEST(ShakenTable, OfACompliantContactMovesAlike) {
  const json& row = reference()["shaken_table"]["rows"][2];
  const Finished run = shaken(row, compliant);
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (int k = 1; k <= 8; ++k) EXPECT_NEAR(run.series.at("x")[k], number(row["rel_at_periods"][k - 1]), 1e-8);
}

// A block on two feet, b wide and h high by halves, J = m R^2/3, tilted by theta about its left or right foot.
std::string rocking(double b, double h, double theta, double mu) {
  const double R = std::hypot(b, h), alpha = std::atan2(b, h);
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {{"block": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "position": [{:.17g}, {:.17g}],
                          "angle": {:.17g}, "markers": {{"left": [{}, {}], "right": [{}, {}]}}}}}},
    "contacts": {{
      "left": {{"type": "constraint_method", "between": ["block.left", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
               "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}},
      "right": {{"type": "constraint_method", "between": ["block.right", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}}}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-12}}}},
    "simulate": {{"until": 1}},
    "record": {{"every": 0.01, "observe": {{"theta": "block.angle", "omega": "block.angular_velocity"}}}}
  }})",
                     R * R / 3, R * std::sin(alpha - theta), R * std::cos(alpha - theta), theta, -b, -h, b, -h, mu, mu,
                     mu, mu);
}

TEST(RockingBlock, FallsBackInHousnersTimeAndKeepsHisShareOfItsRate) {
  for (const json& shape : reference()["rocking_block"]) {
    const double alpha = number(shape["alpha_rad"]);
    for (const json& row : shape["free_rocking"]) {
      const double until = number(row["quarter_period_nonlinear"]) * 1.01;
      // Tilted to the left: it stands on its left foot, the right one strikes.
      const Finished run = run_text(
          rocking(number(shape["half_width"]), number(shape["half_height"]), number(row["theta0_over_alpha"]) * alpha,
                  10),
          {{"simulate.until", fmt::format("{:.17g}", until)}, {"record.every", fmt::format("{:.17g}", until / 1000)}});
      ASSERT_TRUE(run.done()) << run.report.reason;
      const std::vector<Event> impacts = run.of_kind("impact");
      ASSERT_EQ(impacts.size(), 1u) << row.dump();
      EXPECT_EQ(impacts[0].contact, "contacts.right");
      EXPECT_NEAR(impacts[0].t, number(row["quarter_period_nonlinear"]), 1e-9);
      // The rate just before: the foot's approach is 2 b omega.
      EXPECT_NEAR(impacts[0].detail.at("approach") / (2 * number(shape["half_width"])),
                  number(row["omega_before_first_impact_nonlinear"]), 1e-9);
      const std::vector<Event> open = run.of_kind("contact_open");
      ASSERT_EQ(open.size(), 1u);
      EXPECT_EQ(open[0].contact, "contacts.left");
      EXPECT_NEAR(open[0].detail.at("separation") / (2 * number(shape["half_width"])),
                  number(row["omega_after_first_impact"]), 1e-9);
      EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9);
    }
  }
}

TEST(RockingBlock, ComesToRestAfterImpactsWithoutEnd) {
  // Each impact leaves 1 - 1.5 sin(alpha)^2 = 0.876 of the rate, so all end in a finite time; the remainder of the last
  // ones is too little to follow.
  const Finished run = run_text(rocking(0.3, 1, 0.02, 2), {{"simulate.until", "5"}, {"record.every", "0.1"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(run.of_kind("impact").size(), 20u);
  EXPECT_NEAR(run.end("theta"), 0, 1e-9);
  EXPECT_NEAR(run.end("omega"), 0, 1e-9);
  EXPECT_NEAR(run.result["energy_end"]["total"], 9.81, 1e-7);  // m g h
}

TEST(RigidBlockOnTwoFeet, SticksWithADeterminedSumAndEqualShares) {
  // Pulled by 3 N at its foot's height; N = 4.905 each. Held by -1.5 N each, the split of minimum norm.
  const Finished run = run_text(rocking(0.25, 1, 0, 0.6),
                                {{"forces.pull", R"({"type": "load", "on": "block.left", "force": {"x": 3, "y": 0}})"},
                                 {"record.observe", R"({"L": "contacts.left.friction", "R": "contacts.right.friction",
                                             "x": "block.com.x", "NL": "contacts.left.force"})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("L"), -1.5, 1e-12);
  EXPECT_NEAR(run.end("R"), -1.5, 1e-12);
  EXPECT_NEAR(run.end("x"), run.series.at("x")[0], 1e-14);
  EXPECT_EQ(run.of_kind("slip").size(), 0u);
}

TEST(RigidBlockOnTwoFeet, SticksThoughAFootsShareOfMinimumNormIsOutOfItsBound) {
  // A pull down at the right foot's side leaves the left one 0.2 N: its share of the 3 N is far over 0.6 N_left, but
  // the right foot holds all. Of the sum 0.6 (0.2 + N_right) only what exceeds it moves the block.
  const Finished run =
      run_text(rocking(0.25, 1, 0, 0.6),
               {{"forces.pull", R"({"type": "load", "on": "block.left", "force": {"x": 3, "y": 4.705}})"},
                {"record.observe", R"({"x": "block.com.x", "NL": "contacts.left.force"})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("NL"), 0.2, 1e-12);
  EXPECT_EQ(run.of_kind("slip").size(), 0u);
  EXPECT_NEAR(run.end("x"), run.series.at("x")[0], 1e-14);
}

TEST(RigidBlockOnTwoFeet, SlidesWhenThePullExceedsBothBounds) {
  // 0.6 m g = 5.886 N reached by 6 t N at 0.981 s; then mu = mu_0, so it starts without a jump.
  const Finished run =
      run_text(rocking(0.25, 1, 0, 0.6),
               {{"forces.pull", R"({"type": "load", "on": "block.left", "force": {"x": "=6*t", "y": 0}})"},
                {"simulate.until", "1.3"},
                {"record.observe", R"({"x": "block.com.x"})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("slip").size(), 2u);
  EXPECT_NEAR(run.of_kind("slip")[0].t, 0.981, 1e-8);  // decided by an acceleration of 1e-9 m/s^2
  EXPECT_NEAR(run.of_kind("slip")[1].t, 0.981, 1e-8);
  EXPECT_NEAR(run.end("x") - run.series.at("x")[0], std::pow(1.3 - 0.981, 3), 1e-9);
}

// Points on one floor, at 1 m/s and 0.5 m/s: that the slower one stops is no reason for the other to do so.
TEST(SlidingPoints, StopEachAtItsOwnTimeAndPlace) {
  const double mu = 0.3, g = 9.81;
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {"slow": {"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [0.5, 0]},
               "fast": {"type": "point_mass", "mass": 1, "position": [0, 0], "velocity": [1, 0]}},
    "contacts": {"slow": {"type": "constraint_method", "between": ["slow.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
                          "friction": {"type": "coulomb", "static": 0.3, "kinetic": 0.3}},
                 "fast": {"type": "constraint_method", "between": ["fast.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}],
                          "friction": {"type": "coulomb", "static": 0.3, "kinetic": 0.3}}},
    "simulate": {"until": 0.5}, "record": {"every": 0.1, "observe": {"slow": "slow.point.x", "fast": "fast.point.x"}}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto stops = run.of_kind("stick");
  ASSERT_EQ(stops.size(), 2u);
  EXPECT_NEAR(stops[0].t, 0.5 / (mu * g), 1e-9);
  EXPECT_NEAR(stops[1].t, 1 / (mu * g), 1e-9);
  EXPECT_NEAR(run.end("slow"), 0.25 / (2 * mu * g), 1e-9);
  EXPECT_NEAR(run.end("fast"), 1 / (2 * mu * g), 1e-9);
}

// Painleve's rod of m = l = 1, its tip on the floor sliding to -x at 1 m/s.
std::string rod(double theta, double mu, double omega) {
  const double c = std::cos(theta), s = std::sin(theta);
  return fmt::format(R"({{
    "trammel": 1, "gravity": [0, -9.81],
    "bodies": {{"rod": {{"type": "rigid_body", "mass": 1, "inertia": "=1/3", "position": [{:.17g}, {:.17g}], "angle": {:.17g},
                        "velocity": [{:.17g}, {:.17g}], "angular_velocity": {:.17g}, "markers": {{"tip": [-1, 0]}}}}}},
    "contacts": {{"tip": {{"type": "constraint_method", "between": ["rod.tip", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
                          "friction": {{"type": "coulomb", "static": {:.17g}, "kinetic": {:.17g}}}}}}},
    "integrator": {{"type": "dop853", "step": {{"tolerance": 1e-10}}}},
    "simulate": {{"until": 0.001}}, "record": {{"every": 1e-3, "observe": {{"N": "contacts.tip.force"}}}}
  }})",
                     c, s, theta, -1 - omega * s, omega * c, omega, mu, mu);
}

TEST(PainlevesRod, SlidesPressedByItsUniqueForceWhereThereIsOne) {
  for (const json& row : reference()["painleve"]["rows"]) {
    const std::string kind = row["classification"];
    if (kind.find("p>0") == std::string::npos) continue;
    const Finished run =
        run_text(rod(number(row["theta_deg"]) * pi / 180, number(row["mu"]), number(row["theta_dot"])));
    ASSERT_TRUE(run.done()) << run.report.reason;
    const double N = row["N_slide"].is_null() ? 0 : number(row["N_slide"]);
    EXPECT_NEAR(run.series.at("N")[0], N, 1e-9 * (1 + N)) << row.dump();
  }
}

TEST(PainlevesRod, WithoutASolutionStopsInAnImpactWithoutCollision) {
  // A = (1.6 -1.2; -1.2 3.4) takes (0, -1) m/s to rest with the impulses (0.3, 0.4), inside the cone of mu = 2.
  const Finished run = run_text(rod(std::atan(2.0), 2, 0));
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.of_kind("impact").size(), 1u);
  EXPECT_NEAR(run.of_kind("impact")[0].detail.at("impulse"), 0.3, 1e-14);
  EXPECT_NEAR(run.of_kind("impact")[0].detail.at("friction"), 0.4, 1e-14);
  EXPECT_EQ(run.of_kind("stick").size(), 1u);
}

TEST(PainlevesRod, OfTheCriticalCoefficientHasNoForceOfRoundOff) {
  const Finished run = run_text(rod(std::atan(2.0), 4.0 / 3, 0));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("impact").size(), 1u);
  EXPECT_LT(run.series.at("N")[0], 100);
}

TEST(PainlevesRod, WithSeveralSolutionsTakesOneAndGoesOn) {
  const Finished run = run_text(rod(std::atan(2.0), 2, 4));  // flight, or sliding with N = 5.6
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.series.at("N")[0], 0);  // Lemke's path starts where no force is needed: flight
}

TEST(Friction, AtFirstTouchWithoutSlipSticksAtOnceAndStays) {
  // Falls straight on a compliant floor; the normal force, and so the bound, begin at 0.
  const Finished run =
      run_text(block(0, 0.5, 0.4, 0, compliant), {{"bodies.block.position", "[0, 0.05]"}, {"simulate.until", "2"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("slip").size(), 0u);
  EXPECT_EQ(run.of_kind("stick").size(), run.of_kind("contact_close").size());
  EXPECT_EQ(run.end("x"), 0);
}

TEST(Friction, WithMuZeroIsNoFriction) {
  const Finished run = run_text(block(0.1, 0, 0, 1, rigid));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("x"), 1 - 9.81 * std::sin(0.1) / 2, 1e-12);
  EXPECT_EQ(run.result["energy_dissipated"]["friction_total"], 0);
}

TEST(Friction, OfAnImpactEndsTheSlipOrIsMuTimesItsImpulse) {
  // Thrown at 1 m/s downwards: L = 1, so an e = 0 impact takes mu of slip: 0.5 of 2 m/s, or all of 0.3 m/s.
  for (const auto& [slip, left] : {std::pair{2.0, 1.5}, {0.3, 0.0}}) {
    const Finished run =
        run_text(block(0, 0.5, 0.5, slip, rigid), {{"bodies.block.velocity", fmt::format("[{}, -1]", slip)},
                                                   {"simulate.until", "1e-9"},
                                                   {"record.every", "1e-9"}});
    ASSERT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.series.at("vx")[0], left, 1e-14);
    EXPECT_NEAR(run.of_kind("impact").at(0).detail.at("friction"), left - slip, 1e-14);
    EXPECT_NEAR(run.result["energy_dissipated"]["impact_total"], 0.5 + (slip * slip - left * left) / 2, 1e-14);
  }
}

TEST(Friction, RegularisedCreepsDownTheInclineItsCoefficientHolds) {
  // tanh(v / v_c) = tan(phi) / mu.
  const double phi = 0.3;
  const Finished run =
      run_text(block(phi, 0.6, 0.6, 0, rigid),
               {{"contacts.foot.friction",
                 R"({"type": "regularized_coulomb", "coefficient": 0.6, "critical_velocity": 1e-3})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("vx"), -1e-3 * std::atanh(std::tan(phi) / 0.6), 1e-9);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-9);
}

TEST(Friction, DecidedAtEveryStepStopsTheBlockToTheOrderOfItsSteps) {
  const json& row = reference()["incline"]["upward_launch_then_stay"];
  const Finished run =
      run_text(block(20 * pi / 180, 0.6, 0.48, 2, compliant, R"({"type": "runge_kutta_4", "step": 1e-4})"),
               {{"contacts.foot.friction.method", "lcp_every_step"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("x"), number(row["distance"]), 1e-9);
  EXPECT_NEAR(run.end("vx"), 0, 1e-6);             // its stick_speed
  EXPECT_EQ(run.result["sizes"].back()["nc"], 0);  // no row: the force is found at each evaluation
}

TEST(Friction, DecidedAtEveryStepLetsGoAtTheEndOfAStep) {
  const json& row = reference()["shaken_table"]["rows"][2];
  const auto error = [&](const char* step) {
    const Finished run = run_text(
        block(0, 0.5, 0.5, 0, compliant, fmt::format(R"({{"type": "runge_kutta_4", "step": {}}})", step)),
        {{"contacts.foot.friction.method", "lcp_every_step"},
         {"simulate.until", "2"},
         {"forces.shake",
          fmt::format(
              R"json({{"type": "load", "on": "block.point", "force": {{"x": "={:.17g}*sin(pi*t)", "y": 0}}}})json",
              number(row["X"]) * pi * pi)}});
    EXPECT_TRUE(run.done()) << run.report.reason;
    return std::abs(run.of_kind("stick").at(1).t - number(row["events"][1][1]));
  };
  EXPECT_LT(error("1e-3"), 2e-3);
  EXPECT_LT(error("1e-4"), 2e-4);
}

// A block of 1 kg on two feet, sunk as far as they carry it, that a load at the height of the feet pushes with 2 N/s;
// the same in other units of length.
std::string pushed_on_two_feet(const char* left, const char* right, double unit) {
  const double half = 0.05 * unit, g = 9.81 * unit, stiffness = 1e6;
  const auto foot = [&](const char* name, const char* method) {
    return fmt::format(R"("{}": {{"type": "continuous_force", "stiffness": {}, "exponent": 1, "damping": "none",
        "between": ["b.{}", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}],
        "friction": {{"type": "coulomb", "static": 0.4, "kinetic": 0.3, "method": "{}", "stick_speed": {:.17g}}}}})",
                       name, stiffness, name, method, 1e-6 * unit);
  };
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, {:.17g}],
    "bodies": {{"b": {{"type": "rigid_body", "mass": 1, "inertia": {:.17g}, "position": [0, {:.17g}],
        "markers": {{"l": [{:.17g}, {:.17g}], "r": [{:.17g}, {:.17g}], "low": [0, {:.17g}]}}}}}},
    "contacts": {{{}, {}}},
    "forces": {{"push": {{"type": "load", "on": "b.low", "force": {{"x": "={:.17g}*t", "y": 0}}}}}},
    "integrator": {{"type": "runge_kutta_4", "step": 1e-4}}, "simulate": {{"until": 0.2}},
    "record": {{"every": 0.02, "observe": {{"x": "b.com.x", "l": "contacts.l.friction", "r": "contacts.r.friction"}}}}}})",
                     -g, 0.1 * unit * unit, half - g / 2 / stiffness, -half, -half, half, -half, -half, foot("l", left),
                     foot("r", right), 2 * unit);
}

// Its feet have no rows at rest, so that there are none to share; with one that has a row, that one holds.
TEST(Friction, DecidedAtEveryStepHoldsABlockOnTwoFeet) {
  for (const double unit : {1.0, 1e-6})
    for (const auto& [left, right] :
         {std::pair{"lcp_every_step", "lcp_every_step"}, {"lcp_every_step", "events"}, {"events", "lcp_every_step"}}) {
      SCOPED_TRACE(fmt::format("{} {} in {} m", left, right, unit));
      const Finished run = run_text(pushed_on_two_feet(left, right, unit));
      ASSERT_TRUE(run.done()) << run.report.reason;
      EXPECT_EQ(run.of_kind("slip").size(), 0u);
      EXPECT_NEAR(run.end("l") + run.end("r"), -2 * unit * 0.2, 1e-9 * unit);
      EXPECT_NEAR(run.end("x"), 0, 1e-9 * unit);
      const bool shared = std::string(left) == right, left_holds = std::string(left) == "events";
      EXPECT_NEAR(run.end("l"), shared ? -0.2 * unit : left_holds ? -0.4 * unit : 0, 1e-9 * unit);
    }
}

}  // namespace
}  // namespace trammel::test
