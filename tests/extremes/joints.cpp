// Joined bodies whose masses or lengths differ by 1e9 to 1e12.
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "outcome.hpp"

namespace trammel::test {
namespace {

// Two points, A hung on the ground, B on A, each by 1 m.
std::string chain(const char* mass_of_A, const char* mass_of_B, const char* integrator) {
  return fmt::format(R"json({{
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {{
      "A": {{"type": "point_mass", "mass": {}, "position": [0.1, "=-sqrt(0.99)"]}},
      "B": {{"type": "point_mass", "mass": {}, "position": [0.2, "=-2*sqrt(0.99)"]}}
    }},
    "joints": {{"upper": {{"type": "distance", "between": ["ground", "A.point"], "length": 1}},
               "lower": {{"type": "distance", "between": ["A.point", "B.point"], "length": 1}}}},
    "integrator": {},
    "simulate": {{"until": 2}},
    "record": {{"every": 0.01, "observe": {{"xA": "A.point.x", "xB": "B.point.x"}}}}
  }})json",
                     mass_of_A, mass_of_B, integrator);
}

TEST(MassRatio, OfABillionBelowALightLinkSwingsAsOnePendulumOfTwiceTheLength) {
  // The light mass stays on the line: a pendulum of 2 m from asin(0.1), period 2 pi sqrt(2/g) (1 + theta^2/16).
  const Finished run = run_text(chain("1e-9", "1", R"({"type": "hht_alpha", "alpha": -0.1, "step": 1e-3})"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  const double theta = std::asin(0.1), period = 2 * std::numbers::pi * std::sqrt(2 / 9.81) * (1 + theta * theta / 16);
  const auto& x = run.series.at("xB");
  const auto at = [&](double t) { return 0.2 * std::cos(2 * std::numbers::pi * t / period); };
  for (std::size_t k = 0; k < x.size(); k += 20) EXPECT_NEAR(x[k], at(double(k) * 0.01), 2e-4) << k;
  EXPECT_LT(run.result["constraint_maxima"]["position"], 1e-12);
}

TEST(MassRatio, OfABillionAboveALightLinkSwingsAsIfItWereAlone) {
  const Finished run = run_text(chain("1", "1e-9", R"({"type": "dop853", "step": {"tolerance": 1e-11}})"));
  const Finished alone = run_text(chain("1", "1e-12", R"({"type": "dop853", "step": {"tolerance": 1e-11}})"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (std::size_t k = 0; k < run.series.at("xA").size(); k += 20)
    EXPECT_NEAR(run.series.at("xA")[k], alone.series.at("xA")[k], 2e-8) << k;  // the light one's weight, 1e-9, over 2 s
  // The rows are not stabilised: some 700 steps of 1e-11 in the rate, 2 s long, against 9.81 N.
  EXPECT_NEAR(run.result["energy_drift"], 0, 1.4e-7);
}

// Two rods of 1 m, held out and let go: angles at 2 s, in minimal coordinates by RK4 in steps of 1e-4 s.
std::array<double, 2> rods_at_2_s(double m_1, double m_2) {
  const double g = 9.81, a_11 = m_1 / 3 + m_2, a_22 = m_2 / 3;
  const auto rate = [&](const Eigen::Array4d& y) {
    const double a_12 = m_2 / 2 * std::cos(y[0] - y[1]), h = m_2 / 2 * std::sin(y[0] - y[1]);
    const double b_1 = -h * y[3] * y[3] - (m_1 / 2 + m_2) * g * std::cos(y[0]);
    const double b_2 = h * y[2] * y[2] - m_2 / 2 * g * std::cos(y[1]);
    const double d = a_11 * a_22 - a_12 * a_12;
    return Eigen::Array4d(y[2], y[3], (a_22 * b_1 - a_12 * b_2) / d, (a_11 * b_2 - a_12 * b_1) / d);
  };
  const double h = 1e-4;
  Eigen::Array4d y = Eigen::Array4d::Zero();
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Array4d k_1 = rate(y), k_2 = rate(y + h / 2 * k_1), k_3 = rate(y + h / 2 * k_2),
                         k_4 = rate(y + h * k_3);
    y += h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4);
  }
  return {y[0], y[1]};
}

// Multipliers of 1e7 N cancel in the light rod's accelerations: 1e3 m/s^2 of round-off without a correction.
TEST(MassRatio, OfATrillionTakesRodsNoMoreStepsThanEqualMasses) {
  const Finished run = run_text(R"json({
    "trammel": 1, "space": "planar", "gravity": [0, -9.81],
    "bodies": {
      "light": {"type": "rigid_body", "mass": 1e-6, "inertia": "=1e-6/12", "position": [0.5, 0], "markers": {"a": [-0.5, 0], "b": [0.5, 0]}},
      "heavy": {"type": "rigid_body", "mass": 1e6, "inertia": "=1e6/12", "position": [1.5, 0], "markers": {"a": [-0.5, 0]}}
    },
    "joints": {"upper": {"type": "revolute", "between": ["ground", "light.a"]},
               "lower": {"type": "revolute", "between": ["light.b", "heavy.a"]}},
    "integrator": {"type": "dop853", "rows": "projected", "step": {"tolerance": 1e-6}},
    "simulate": {"until": 2},
    "record": {"every": 1, "observe": {"light": "light.angle", "heavy": "heavy.angle"}}
  })json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto exact = rods_at_2_s(1e-6, 1e6);
  EXPECT_NEAR(run.end("light"), exact[0], 1e-6);
  EXPECT_NEAR(run.end("heavy"), exact[1], 1e-6);
  EXPECT_LT(run.result["counts"]["steps"], 100);  // 7400 without the correction
}

// Coordinates of 5e5 m are known to 1e-10 m, which is 1e-4 of the short rod's length, at each of 2000 steps: no method
// that puts its steps onto the rows knows its angle better than that, but none may stop or halve its steps for it. The
// exact one is -0.44836 (RK4, dop853). Whether an iteration ends must not hang on how coordinates happen to round: so
// the step is varied a little.
TEST(LengthRatio, OfATrillionIsNoReasonToStop) {
  for (const char* method : {"hht_alpha", "generalized_alpha"})
    for (const double step : {1e-5, 1.01e-5, 1.03e-5, 1.04e-5, 1.06e-5, 1.09e-5}) {
      const Finished run = run_text(fmt::format(R"json({{
        "trammel": 1, "space": "planar", "gravity": [0, -9.81],
        "bodies": {{
          "short": {{"type": "rigid_body", "mass": 1, "inertia": "=1e-12/12", "position": [5e-7, 0], "markers": {{"a": [-5e-7, 0], "b": [5e-7, 0]}}}},
          "long": {{"type": "rigid_body", "mass": 1, "inertia": "=1e12/12", "position": ["=1e-6+5e5", 0], "markers": {{"a": [-5e5, 0]}}}}
        }},
        "joints": {{"upper": {{"type": "revolute", "between": ["ground", "short.a"]}},
                   "lower": {{"type": "revolute", "between": ["short.b", "long.a"]}}}},
        "integrator": {{"type": "{}", "step": {}}},
        "simulate": {{"until": 0.02}},
        "record": {{"every": 0.001, "observe": {{"angle": "short.angle"}}}}
      }})json",
                                                method, step));
      ASSERT_TRUE(run.done()) << method << ", " << step << ": " << run.report.reason;
      EXPECT_EQ(run.result["counts"]["rejected"], 0) << method << ", " << step;
      EXPECT_NEAR(run.end("angle"), -0.44836, 0.02) << method << ", " << step;
    }
}

TEST(MassRatio, OfABillionInAnImpactLeavesTheHeavyBodyAlone) {
  // A light point on a rod strikes; the heavy one at the other end falls on, and pushes the light one aside.
  const Finished run = run_text(R"json({
    "trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"heavy": {"type": "point_mass", "mass": 1e6, "position": [0, 2]},
               "light": {"type": "point_mass", "mass": 1e-3, "position": [1, 1]}},
    "joints": {"link": {"type": "distance", "between": ["heavy.point", "light.point"], "length": "=sqrt(2)"}},
    "contacts": {"floor": {"type": "constraint_method", "restitution": 0,
                           "between": ["light.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
    "integrator": {"type": "hht_alpha", "alpha": 0, "step": 1e-4},
    "simulate": {"until": 0.5},
    "record": {"every": 0.01, "observe": {"heavy_y": "heavy.point.y", "light_x": "light.point.x"}}
  })json");
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events[0].t, std::sqrt(0.2), 1e-9);
  // The heavy one holds the light one along the rod, at 45 degrees: half of its mobility is left, so 2 m v stop it.
  EXPECT_NEAR(run.events[0].detail.at("impulse"), 2 * 1e-3 * std::sqrt(20.0), 1e-10);
  EXPECT_NEAR(run.end("heavy_y"), 2 - 5 * 0.25, 1e-8);  // and falls on freely
  EXPECT_LT(run.result["constraint_maxima"]["position"], 1e-12);
}

}  // namespace
}  // namespace trammel::test
