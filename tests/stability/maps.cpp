// Measured maps against theory that was derived apart from the methods' code.
#include <cmath>
#include <complex>
#include <vector>

#include <gtest/gtest.h>

#include "stability/integrator_under_test.hpp"
#include "stability/page.hpp"
#include "stability/region.hpp"
#include "stability/small_steps.hpp"
#include "stability/spectral_map.hpp"

namespace trammel::stability {
namespace {

IntegratorUnderTest subject(const std::string& name, std::vector<scene::Override> settings = {}) {
  static plugin::Registry registry;
  return {registry, name, std::move(settings)};
}

const LinearTheory& theory_of(const std::unique_ptr<Integrator>& method) {
  return dynamic_cast<const LinearTheory&>(*method);
}

struct Case {
  std::string name;
  std::vector<scene::Override> settings;
};

class EveryTheory : public testing::TestWithParam<Case> {};

// Roots of a double root are known to the square root of round-off, 1e-8; round-off grows with Omega^2 up to 1e6.
TEST_P(EveryTheory, IsWhatTheMethodDoes) {
  const IntegratorUnderTest under_test = subject(GetParam().name, GetParam().settings);
  const auto method = under_test.maker()();
  for (const double zeta : {0.0, 0.05, 0.7})
    for (const MapPoint& p : spectral_map(under_test.maker(), &theory_of(method), zeta, logarithmic(1e-2, 1e3, 31))) {
      // A growing motion may end beyond the range of numbers: it need only grow by both.
      if (p.theory->radius > 1 + growth && (!p.measured || p.measured->radius > 1 + growth)) continue;
      ASSERT_TRUE(p.measured) << "Omega " << p.Omega;
      EXPECT_NEAR(p.measured->radius, p.theory->radius, 1e-5) << "Omega " << p.Omega << ", zeta " << zeta;
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryTheory,
                         testing::Values(Case{"newmark", {}}, Case{"newmark", {{"gamma", "0.6"}, {"beta", "0.3025"}}},
                                         Case{"hht_alpha", {}}, Case{"hht_alpha", {{"alpha", "-0.3"}}},
                                         Case{"generalized_alpha", {{"rho_inf", "0.5"}}},
                                         Case{"generalized_alpha", {{"rho_inf", "0"}}}, Case{"runge_kutta_4", {}},
                                         Case{"dormand_prince", {}}, Case{"dop853", {}}, Case{"adams_baumgarte", {}},
                                         Case{"adams_baumgarte", {{"predictor", "ab3"}}}),
                         [](const auto& one) { return one.param.name + "_" + std::to_string(one.index); });

// -rho_inf is the triple root of generalised alpha at infinity (Chung, Hulbert 1993). At Omega = 1e6 the three
// roots are still 1.6e-4 away from it, and round-off moves each by its cube root; the coefficients of their polynomial,
// (z + rho)^3, are 1e-11 away, and round-off moves them by itself.
TEST(SpectralMap, OfGeneralisedAlphaEndsAtRhoInf) {
  const double rho = 0.6;
  const auto method = subject("generalized_alpha", {{"rho_inf", "0.6"}}).maker()();
  const std::vector<std::complex<double>> z = theory_of(method).roots(1e6, 0);
  ASSERT_EQ(z.size(), 3u);
  EXPECT_NEAR(std::abs(z[0] + z[1] + z[2] + 3 * rho), 0, 1e-10);
  EXPECT_NEAR(std::abs(z[0] * z[1] + z[1] * z[2] + z[2] * z[0] - 3 * rho * rho), 0, 1e-10);
  EXPECT_NEAR(std::abs(z[0] * z[1] * z[2] + rho * rho * rho), 0, 1e-10);
}

// The trapezoidal rule maps Omega to 2 atan(Omega/2) without damping.
TEST(SpectralMap, OfTheTrapezoidalRuleHasItsPeriod) {
  const auto method = subject("newmark").maker()();
  const auto map =
      spectral_map(subject("newmark").maker(), &theory_of(method), 0, std::vector<double>{0.1, 1, 3, 6, 50});
  for (const MapPoint& p : map) {
    const double exact = p.Omega / (2 * std::atan(p.Omega / 2));
    for (const Oscillation& o : {*p.measured, *p.theory}) {
      EXPECT_NEAR(o.period_error, exact - 1, 1e-9 * exact) << p.Omega;
      EXPECT_NEAR(o.damping, 0, 1e-9) << p.Omega;
    }
  }
}

// sqrt(8) on the imaginary axis, 2.785293563405282 on the real one (Hairer, Wanner, IV.2); bisection to 0.05/2^14 and
// growth beyond 1e-6 limit the digits.
TEST(Region, OfRungeKutta4EndsWhereItsPolynomialSays) {
  const auto points = motion_region(subject("runge_kutta_4").maker(), nullptr, 8, 2);
  EXPECT_NEAR(points.front().measured, 2.785293563405282, 1e-5);
  EXPECT_NEAR(points.back().measured, std::sqrt(8.0), 1e-5);
}

TEST(Region, OfBaumgartesWeightsIsThatOfTheMotion) {
  const IntegratorUnderTest rk4 = subject("runge_kutta_4");
  const auto rows = row_region(
      [&](double delta, double epsilon) {
        return rk4.maker({{"delta", std::to_string(delta)}, {"epsilon", std::to_string(epsilon)}});
      },
      nullptr, 8, 4);
  const auto motion = motion_region(rk4.maker(), nullptr, 8, 4);
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_NEAR(rows[i].measured, motion[i].measured, 1e-4);
}

// 1e-16/(beta h^2) at h = 1e-8 is of the size of lambda; with velocity rows digits remain.
TEST(SmallSteps, DrownTheMultipliersOfIndex3Alone) {
  const auto at = [](const char* formulation) {
    return small_steps(subject("hht_alpha", {{"formulation", formulation}}).maker(), std::vector<double>{1e-8}).front();
  };
  EXPECT_LT(at("stabilised").lambda_error, 1e-4);
  EXPECT_GT(at("index3").lambda_error, 1e-2);
}

TEST(IntegratorUnderTest, RefusesAParameterOutOfRangeByName) {
  try {
    subject("hht_alpha", {{"alpha", "-0.5"}});
    FAIL() << "accepted";
  } catch (const scene::SceneError& e) {
    EXPECT_NE(std::string(e.what()).find("alpha: found -0.5"), std::string::npos) << e.what();
  }
}

TEST(StabilityPage, SaysWhereRungeKuttaEnds) {
  const report::Page page = measure(subject("runge_kutta_4"));
  std::string all;
  for (const std::string& s : page.sentences) all += s + "\n";
  EXPECT_NE(all.find("up to omega h = 2.8284"), std::string::npos) << all;
}

}  // namespace
}  // namespace trammel::stability
