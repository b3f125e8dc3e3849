// Contacts at the edge: restitution, stabilisation, stiffness, grazing, closed at the start, a million impacts.
#include <cmath>
#include <numbers>

#include "support/scenes.hpp"
#include "outcome.hpp"

namespace trammel::test {
namespace {

TEST(Restitution, OfZeroAndOneAreExact) {
  const Finished plastic = run_text(ball, {{"contacts.floor.restitution", "0"}});
  EXPECT_EQ(plastic.of_kind("impact").at(0).detail.at("separation"), 0);
  const Finished elastic = run_text(ball, {{"contacts.floor.restitution", "1"}});
  const auto impact = elastic.of_kind("impact").at(0).detail;
  EXPECT_EQ(impact.at("separation"), impact.at("approach"));
  EXPECT_EQ(impact.at("energy_lost"), 0);
}

TEST(Restitution, OfOneOfTheBeamKeepsItsEnergy) {
  const Finished run =
      run_file("beam_impact/accurate.json", {{"parameters.e", "1"}, {"parameters.N", "3"}, {"simulate.until", "0.4"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(run.result["counts"]["impacts"], 3);
  EXPECT_NEAR(run.end("energy_total"), 3.01311517042, 1e-9);
}

class Baumgarte : public testing::TestWithParam<double> {};

TEST_P(Baumgarte, FromNothingToFarPastItsStabilityEndsInAResultOrAClearError) {
  // Critically damped, epsilon = delta; with h = 1e-3 s the row is unstable beyond a few hundred 1/s.
  const Finished run = run_text(
      struck_bar,
      {{"integrator",
        fmt::format(R"({{"type": "adams_baumgarte", "delta": {0}, "epsilon": {0}, "step": 1e-3}})", GetParam())}});
  if (!run.done()) return expect_clear_failure(run);
  expect_finite(run);
  // What is called done holds the hinge.
  EXPECT_LT(run.result["constraint_maxima"]["position"], 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Delta, Baumgarte, testing::Values(0, 1, 100, 1e3, 1e4, 1e6, 1e9, 1e100),
                         [](const auto& d) { return fmt::format("n{}", d.index); });

class ContactStiffness : public testing::TestWithParam<const char*> {};

TEST_P(ContactStiffness, GivesBackTheBallOrSaysWhyNot) {
  const Finished run =
      run_text(ball, {{"contacts.floor", fmt::format(
                                             R"({{"type": "continuous_force", "stiffness": {}, "damping": "none",
        "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                                             GetParam())},
                      {"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-10}})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GE(run.of_kind("contact_open").size(), 2u);
  EXPECT_NEAR(run.end("energy_total"), 1.0125, 1e-6);
}

TEST_P(ContactStiffness, WithAStepTooLongForItEndsInAResultOrAClearError) {
  for (const char* type : {"newmark", "runge_kutta_4", "hht_alpha"}) {
    const Finished run =
        run_text(ball, {{"contacts.floor", fmt::format(
                                               R"({{"type": "continuous_force", "stiffness": {}, "damping": "none",
          "between": ["ball.point", {{"plane": {{"point": [0, 0], "normal": [0, 1]}}}}]}})",
                                               GetParam())},
                        {"integrator.type", type}});
    expect_result_or_clear_failure(run, 1.0125 / 3.0131 * 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(K, ContactStiffness, testing::Values("1e4", "1e6", "1e8", "1e10", "1e12", "1e14"),
                         [](const auto& K) { return std::string(K.param); });

// x = t, y = (t-1)^2 g/2 + gap: the lowest point is `gap` over the plane.
Finished graze(double gap, const char* integrator) {
  return run_text(ball, {{"gravity", "[0, 10]"},
                         {"bodies.ball.velocity", "[1, -10]"},
                         {"bodies.ball.position", fmt::format("[0, {:.17g}]", 5 + gap)},
                         {"integrator", integrator}});
}

TEST(GrazingImpact, OfAHairsBreadthIsAnImpactAndOneAboveIsNot) {
  for (const char* integrator : {R"({"type": "runge_kutta_4", "step": 1e-2})", R"({"type": "hht_alpha", "step": 1e-2})",
                                 R"({"type": "dop853", "step": {"tolerance": 1e-10}})"}) {
    const Finished touched = graze(-1e-9, integrator), missed = graze(1e-9, integrator);
    ASSERT_TRUE(touched.done()) << touched.report.reason;
    ASSERT_EQ(touched.of_kind("impact").size(), 1u) << integrator;
    // At the depth d the speed is sqrt(2 g d).
    EXPECT_NEAR(touched.of_kind("impact")[0].detail.at("approach"), std::sqrt(2e-8), 1e-7) << integrator;
    EXPECT_TRUE(missed.events.empty()) << integrator;
    EXPECT_NEAR(missed.end("y"), 5 + 1e-9, 1e-9);
  }
}

TEST(GrazingImpact, AtExactlyNothingEndsEitherWayWithTheSameMotion) {
  const Finished run = graze(0, R"({"type": "dop853", "step": {"tolerance": 1e-10}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("y"), 5, 2e-6);  // round-off of y, 1e-14, is a speed of sqrt(2 g 1e-14) there
}

TEST(ContactClosedAtTheStart, CarriesItsWeightFromTheFirstRow) {
  const Finished run = run_text(ball, {{"bodies.ball.position", "[0, 0]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_EQ(run.events.size(), 1u);
  EXPECT_EQ(run.events[0].kind, "contact_close");
  EXPECT_EQ(run.events[0].t, 0);
  EXPECT_NEAR(run.series.at("force").front(), 1, 1e-14);
  EXPECT_NEAR(run.end("y"), 0, 1e-15);
}

TEST(ContactClosedAtTheStart, AndApproachingIsAnImpactAtOnce) {
  const Finished run = run_text(ball, {{"bodies.ball.position", "[0, 0]"}, {"bodies.ball.velocity", "[0, -2]"}});
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].kind, "impact");
  EXPECT_EQ(run.events[0].t, 0);
  EXPECT_DOUBLE_EQ(run.events[0].detail.at("separation"), 1);
}

TEST(ContactClosedAtTheStart, AndSeparatingFliesOff) {
  const Finished run = run_text(
      ball, {{"bodies.ball.position", "[0, 0]"}, {"bodies.ball.velocity", "[0, 2]"}, {"simulate.until", "0.3"}});
  EXPECT_TRUE(run.events.empty());
  EXPECT_NEAR(run.end("y"), 2 * 0.3 - 5 * 0.09, 1e-13);
}

TEST(MillionImpacts, AreCountedAndKeepTheEnergy) {
  // Between two walls 1 m apart at 1000 m/s: an impact each millisecond.
  const Finished run = run_scene(scene::Scene::parse(R"({
    "trammel": 1, "space": "planar", "gravity": [0, 0],
    "bodies": {"ball": {"type": "point_mass", "mass": 1, "position": [0.5, 0], "velocity": [1000, 0]}},
    "contacts": {
      "left": {"type": "constraint_method", "restitution": 1, "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [1, 0]}}]},
      "right": {"type": "constraint_method", "restitution": 1, "between": ["ball.point", {"plane": {"point": [1, 0], "normal": [-1, 0]}}]}
    },
    "integrator": {"type": "runge_kutta_4", "step": 1e-3},
    "simulate": {"until": 1000}, "record": {"every": 10, "observe": {"x": "ball.point.x"}}
  })",
                                                     "test.json"),
                                 false);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.result["counts"]["impacts"], 1000000);
  EXPECT_EQ(run.end("energy_kinetic"), 5e5);
  // Each impact is located at most 2 eps t after its time, at 1000 m/s: 2 eps 1000 m/s times the sum of their times,
  // 5e8 s.
  EXPECT_NEAR(run.end("x"), 0.5, 2.3e-4);
}

TEST(ZeroLengthRun, OfTheBeamHasOneRow) {
  const Finished run = run_file("beam_impact.json", {{"simulate.until", "0"}});
  EXPECT_TRUE(run.done());
  ASSERT_EQ(run.series.at("t").size(), 1u);
  EXPECT_NEAR(run.end("energy_total"), 3.01311517042, 1e-11);
}

}  // namespace
}  // namespace trammel::test
