// The compliant contact law beyond the checks of shipped_components.cpp: its formulas, and rebounds as they say.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <trammel/contact.hpp>

#include "support/made.hpp"

namespace trammel::test {
namespace {

struct Law {
  std::string damping;
  double restitution;
  double factor;  // c v0, from the papers named in continuous_force.cpp
};

const Law laws[] = {
    {"none", 0.3, 0},
    {"hunt_crossley", 0.3, 1.5 * 0.7},
    {"lankarani_nikravesh", 0.3, 0.75 * 0.91},
    {"lankarani_nikravesh", 0, 0.75},
    {"paper", 0.3, 0.75 * 0.91},
    {"flores", 0.3, 1.6 * 0.7 / 0.3},
    {"flores", 0.05, 1.6 * 0.95 / 0.05},
};

std::unique_ptr<ContactForce> contact(const std::string& damping, double restitution, double exponent = 1.5) {
  return made<ContactForce>(Kind::contact, R"({"type": "continuous_force", "stiffness": 1e8, "damping": ")" + damping +
                                               R"(", "restitution": )" + std::to_string(restitution) +
                                               R"(, "exponent": )" + std::to_string(exponent) + "}");
}

class ContinuousForce : public testing::TestWithParam<Law> {
 protected:
  const std::unique_ptr<ContactForce> law = contact(GetParam().damping, GetParam().restitution);
};

TEST_P(ContinuousForce, IsTheFormulaOfItsPaper) {
  const double delta = 3e-4, delta_dot = 0.8, v0 = 2;
  const double expected = 1e8 * std::pow(delta, 1.5) * (1 + GetParam().factor * delta_dot / v0);
  EXPECT_NEAR(law->normal(-delta, -delta_dot, v0), expected, 1e-12 * expected);  // round-off
}

TEST_P(ContinuousForce, IsCutWithItsSlopeWhereTheFormulaWouldPull) {
  const double factor = GetParam().factor, beyond = 2 / std::max(factor, 1e-3);  // 1 - factor * beyond = -1, if damped
  EXPECT_EQ(law->normal(-1e-4, beyond, 1) == 0, factor > 0);
  EXPECT_EQ(law->slope(-1e-4, beyond, 1).by_gap == 0, factor > 0);
  EXPECT_EQ(law->slope(-1e-4, beyond, 1).by_rate, 0);
}

TEST_P(ContinuousForce, HasNoDampingIfItWasClosedAtRest) {
  const double elastic = 1e8 * std::pow(1e-4, 1.5);
  for (double rate : {-1.0, 0.0, 1.0}) EXPECT_NEAR(law->normal(-1e-4, rate, 0), elastic, 1e-12 * elastic);
}

// A mass of 1 kg strikes at 1 m/s: (gap, rate) by the classical Runge-Kutta method in 2e4 steps per contact, to the
// crossing.
// Returned: rate at the end over speed at the start, the realised restitution.
double strike(const ContactForce& law) {
  const double h = 1e-7;  // an impact takes 2 ms
  double x = 0, v = -1;
  const auto force = [&](double gap, double rate) { return law.normal(gap, rate, 1); };
  while (true) {
    const double a1 = force(x, v);
    const double a2 = force(x + h / 2 * v, v + h / 2 * a1);
    const double a3 = force(x + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2);
    const double a4 = force(x + h * v + h * h / 2 * a2, v + h * a3);
    const double x_next = x + h * v + h * h / 6 * (a1 + a2 + a3);
    const double v_next = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (x_next >= 0) return v_next;  // the force ends as delta^1.5: v is constant to 1e-10 over the last step
    x = x_next, v = v_next;
  }
}

// m v dv / (1 + c v / v0) = -K delta^n d delta, integrated in and out.
TEST_P(ContinuousForce, ReboundsAsTheEnergyIntegralSays) {
  const double c = GetParam().factor, e = strike(*law);
  EXPECT_NEAR(c * (1 + e), std::log((1 + c) / (1 - c * e)), 1e-6 * (1 + c / (1 - c * e)));  // d/de times 1e-6
}

INSTANTIATE_TEST_SUITE_P(Laws, ContinuousForce, testing::ValuesIn(laws), [](const auto& test_case) {
  return test_case.param.damping + "_" + std::to_string(int(std::lround(100 * test_case.param.restitution)));
});

TEST(ContinuousForceOfThePaper, RealisesTheRestitutionsOfTheReference) {
  // beam.json, effective_restitution_of_this_law_single_mass: given to five digits.
  const double reference[][2] = {{0, 0.66296},   {0.1, 0.66527}, {0.3, 0.68422},
                                 {0.5, 0.72524}, {0.7, 0.79597}, {0.9, 0.91318}};
  for (const auto& [nominal, realised] : reference)
    EXPECT_NEAR(strike(*contact("paper", nominal)), realised, 6e-6) << "nominal " << nominal;
}

TEST(ContinuousForceOfThePaper, RealisesTheSameRestitutionForAnyExponent) {
  EXPECT_NEAR(strike(*contact("paper", 0.3, 1.2)), 0.68422, 6e-6);
  EXPECT_NEAR(strike(*contact("paper", 0.3, 2.0)), 0.68422, 6e-6);
}

TEST(ContinuousForceOfFlores, RealisesNearlyTheNominalRestitution) {
  // The factor 8 (1 - e) / (5 e) comes from an approximate energy balance; its closed form is off by 0.0455 at most (e
  // = 0.24).
  for (double e : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0})
    EXPECT_NEAR(strike(*contact("flores", e)), e, 0.046) << "nominal " << e;
}

TEST(ContinuousForceOfFlores, RefusesRestitutionZeroByName) {
  const std::string text = refusal(
      Kind::contact, R"({"type": "continuous_force", "stiffness": 1e8, "damping": "flores", "restitution": 0})");
  EXPECT_NE(text.find("restitution"), std::string::npos) << text;
  EXPECT_NE(text.find("flores"), std::string::npos) << text;
}

}  // namespace
}  // namespace trammel::test
