// The beam with methods, steps, modes and stiffness at the edge.
#include <cmath>

#include "outcome.hpp"

namespace trammel::test {
namespace {

// The fastest mode of N = 5: 70576 rad/s.
constexpr double omega_max = 70576;

Finished swing(const Overrides& more) {
  Overrides overrides = {{"contacts", "{}"}};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run_file("beam_impact.json", overrides);
}

std::string number(double x) {
  return fmt::format("{:.17g}", x);
}

TEST(Alpha, OfZeroKeepsTheEnergyOfTheSwing) {
  const Finished run = swing({{"parameters.alpha", "0"}, {"simulate.until", "0.369"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("energy_total"), 3.01311517042, 1e-5);  // (h omega)^2 of the bending energy, 1e-4 J
}

TEST(Alpha, OfMinusAThirdOnlyTakesEnergyAndReboundsLikeTheReference) {
  const Finished run =
      run_file("beam_impact.json",
               {{"parameters.alpha", "-0.33333333333333331"}, {"parameters.e", "0"}, {"simulate.until", "0.39"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(run.result["energy_drift"], 0);
  EXPECT_NEAR(run.end("theta"), 0.0288607975938, 0.01);  // as the reference's own HHT
}

class StepTimesOmega : public testing::TestWithParam<double> {};

TEST_P(StepTimesOmega, OfHhtEndsInAResultOrAClearError) {
  const double h = GetParam() / omega_max;
  // Twenty steps, or fewer over the last 0.1 s.
  const Finished run =
      swing({{"integrator.step", number(h)}, {"simulate.until", number(20 * h)}, {"record.every", number(5 * h)}});
  expect_result_or_clear_failure(run);
  if (GetParam() <= 10) {
    EXPECT_TRUE(run.done()) << run.report.reason;
    EXPECT_NEAR(run.end("energy_total"), 3.01311517042,
                3e-6);  // all that bends in that time, as the reference has it at 0.1 s
  }
}

// HHT-alpha overshoots once in velocity where h omega is huge, 5e4 times the energy here, and then damps: no
// divergence.
TEST(AModeFarTooFastForTheStep, OvershootsAndIsDampedOut) {
  const Finished run =
      run_file("beam_impact.json", {{"contacts", "{}"},
                                    {"bodies.beam.mount", R"({"clamped": [0, 0]})"},
                                    {"bodies.beam.angle", "0"},
                                    {"bodies.beam.coupling", R"("none")"},
                                    {"bodies.beam.youngs_modulus", "6.8952e16"},
                                    {"bodies.beam.initial", R"({"transverse": [0.01, 0, 0.001, 0, 0]})"},
                                    {"integrator", R"({"type": "hht_alpha", "alpha": -0.1, "step": 1e-3})"},
                                    {"gravity", "[0, 0]"},
                                    {"simulate.until", "0.4"},
                                    {"record", R"({"every": 0.01})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(run.end("energy_total"), 1e-6);
}

TEST_P(StepTimesOmega, OfAnExplicitMethodEndsInAResultOrAClearError) {
  const double h = GetParam() / omega_max;
  const Finished run = swing({{"integrator", fmt::format(R"({{"type": "runge_kutta_4", "step": {}}})", number(h))},
                              {"simulate.until", number(1000 * h)},
                              {"record.every", number(100 * h)}});
  // Stable up to h omega = 2.83.
  if (GetParam() <= 1)
    EXPECT_NEAR(run.end("energy_total"), 3.01311517042, 1e-6) << run.report.reason;
  else
    expect_clear_failure(run);
}

INSTANTIATE_TEST_SUITE_P(Decades, StepTimesOmega,
                         testing::Values(1e-3, 1e-2, 1e-1, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8),
                         [](const auto& x) {
                           const int power = int(std::lround(std::log10(x.param)));
                           return power < 0 ? fmt::format("1em{}", -power) : fmt::format("1e{}", power);
                         });

TEST(NumberOfModes, FromOneToThirtyStartsToSwingAlike) {
  double before = 0;
  for (const int N : {1, 2, 4, 6, 8, 10, 12, 16, 20, 25, 30}) {
    const Finished run = swing({{"parameters.N", std::to_string(N)},
                                {"parameters.alpha", "0"},
                                {"simulate.until", "0.05"},
                                {"integrator.step", "2e-4"}});
    ASSERT_TRUE(run.done()) << N << ": " << run.report.reason;
    EXPECT_NEAR(run.end("energy_total"), 3.01311517042, 1e-6) << N;
    // Rigid: theta'' = -1.5 g cos(theta) / L. Modes change that by their static deflection, 2e-4 rad.
    EXPECT_NEAR(run.end("theta"), 0.7853981634 - 0.5 * 1.5 * 9.81 * std::sqrt(0.5) * 0.0025, 1e-4) << N;
    if (N >= 8) {
      EXPECT_NEAR(run.end("theta"), before, 1e-6) << N;
    }
    before = run.end("theta");
  }
}

TEST(NumberOfModes, OfThirtyStillStrikes) {
  const Finished run = run_file(
      "beam_impact.json",
      {{"parameters.N", "30"}, {"simulate.until", "0.3702"}, {"simulate.contact_hold", "0"}, {"parameters.e", "0"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events[0].t, 0.3700103, 5e-6);  // as for all N >= 3
}

class Stiffness : public testing::TestWithParam<const char*> {};

TEST_P(Stiffness, AMillionTimesOffEndsInAResultOrAClearError) {
  expect_result_or_clear_failure(
      run_file("beam_impact.json", {{"bodies.beam.youngs_modulus", GetParam()}, {"simulate.until", "0.4"}}));
  expect_result_or_clear_failure(
      run_file("beam_impact.json", {{"bodies.beam.youngs_modulus", GetParam()},
                                    {"simulate.until", "1e-3"},
                                    {"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-9}})"}}));
}

INSTANTIATE_TEST_SUITE_P(E, Stiffness, testing::Values("6.8952e16", "6.8952e4"),
                         [](const auto& E) { return E.param[7] == '1' ? "stiffer" : "softer"; });

TEST(StiffBeam, FallsLikeARigidBar) {
  // Until the tip arrives: the quarter of a pendulum from 45 degrees, int dtheta / sqrt(3 g/L (sin 45 - sin theta)).
  const Finished run =
      run_file("beam_impact.json", {{"bodies.beam.youngs_modulus", "6.8952e16"}, {"simulate.until", "0.3702"}});
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events[0].t, 0.37, 2e-5);
  EXPECT_NEAR(run.events[0].detail.at("approach"), std::sqrt(3 * 9.81 * std::sqrt(0.5)), 1e-4);
}

TEST(ContactStep, OfAPicosecondAdvances) {
  // The tip arrives at 0.37001064 s with these free steps; 0.2 ns, some 200 steps, are left.
  const Finished run = run_file("beam_impact.json", {{"integrator.contact_step", "1e-12"},
                                                     {"parameters.e", "0"},
                                                     {"simulate.contact_hold", "0"},
                                                     {"simulate.until", "0.3700106415"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(run.result["counts"]["contact_steps"], 100);
  EXPECT_LT(run.result["constraint_maxima"]["velocity"], 1e-10);
  EXPECT_NEAR(run.result["energy_drift"], 0, 1e-5);
}

}  // namespace
}  // namespace trammel::test
