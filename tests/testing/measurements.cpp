// Measurements of known methods give their known figures (tests/data/integrators.json).
#include <gtest/gtest.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include <trammel/testing/measurements.hpp>

namespace trammel {
namespace {

const std::string plugins = TRAMMEL_BUILD_DIR "/lib/trammel";

const nlohmann::json& reference() {
  static const nlohmann::json all = [] {
    std::ifstream file(TRAMMEL_SOURCE_DIR "/tests/data/integrators.json");
    return nlohmann::json::parse(file);
  }();
  return all;
}

TEST(Order, OfHhtIsTwoForMultipliersToo) {
  const Fit fit =
      measure_order(from_plugin(plugins, "hht_alpha", {{"alpha", -0.3}}), problems::pendulum_with_rod(), 100);
  EXPECT_NEAR(fit.order_q, 2, 0.1) << fit.table;
  EXPECT_NEAR(fit.order_v, 2, 0.1) << fit.table;
  EXPECT_NEAR(fit.order_lambda, 2, 0.1) << fit.table;
}

TEST(Amplification, OfHhtIsThatOfTheTable) {
  const auto make = from_plugin(plugins, "hht_alpha", {{"alpha", -0.2}});
  for (const auto& [Omega, radius] : reference().at("amplification").at("hht_alpha-0.2000").items()) {
    if (std::stod(Omega) > 100) continue;  // a nearly triple root
    EXPECT_NEAR(amplification(make, std::stod(Omega)).radius, radius.get<double>(), 1e-6) << "omega h = " << Omega;
  }
}

TEST(StabilityLimit, OfRungeKutta4IsThatOfTheTable) {
  const auto make = from_plugin(plugins, "runge_kutta_4");
  const auto table = reference().at("explicit_stability_limits").at("rk4");
  EXPECT_NEAR(stability_limit(make, Axis::imaginary), table.at("imag_axis").get<double>(), 1e-5);
  EXPECT_NEAR(stability_limit(make, Axis::negative_real), table.at("neg_real_axis").get<double>(), 1e-5);
}

TEST(ConstraintDrift, OfHhtIsItsIterationsTolerance) {
  const ConstraintDrift drift =
      constraint_drift(from_plugin(plugins, "hht_alpha", {{"alpha", -0.3}}), problems::bead_on_turning_wire(), 100);
  EXPECT_LT(drift.position, 1e-10);
  EXPECT_LT(drift.velocity, 1e-10);
}

}  // namespace
}  // namespace trammel
