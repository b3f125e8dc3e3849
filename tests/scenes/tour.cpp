// The scenes of the tour end as their comments say.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/value.hpp"
#include "commands/simulation.hpp"

#include "support/made.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

// series.csv by column, events.csv.
struct Results {
  std::map<std::string, std::vector<double>> series;
  std::vector<Event> events;
  double end(const std::string& column) const { return series.at(column).back(); }
};

Results run(const std::string& name, const std::vector<scene::Override>& overrides = {}) {
  const std::filesystem::path out = std::filesystem::path(testing::TempDir()) / ("tour_" + name);
  std::filesystem::remove_all(out);
  const scene::Scene scene = scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/tour/" + name + ".json", overrides);
  simulate::RunOptions options;
  options.out = out;
  const simulate::RunReport report = simulate::run(scene, registry(), options);
  EXPECT_EQ(report.status, simulate::Status::done) << report.reason;

  Results results;
  std::ifstream series(out / "series.csv");
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(series, line);
  for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  while (std::getline(series, line)) {
    std::istringstream row(line);
    for (const std::string& column : names) {
      std::getline(row, cell, ',');
      results.series[column].push_back(std::stod(cell));
    }
  }
  results.events = read_events(out / "events.csv");
  std::filesystem::remove_all(out);
  return results;
}

TEST(Tour, PendulumHasThePeriodOfTheEllipticIntegral) {
  // A quarter of 4 K(sin 45 deg) sqrt(I_O / (m g L / 2)): from the horizontal to the vertical.
  const double quarter = 7.416298709205487 / 4 * std::sqrt(2.0 / (3 * 9.81));
  const auto error = [&](const char* step) {
    return run("01_pendulum", {{"simulate.until", fmt::format("{}", quarter)}, {"integrator.step", step}})
               .end("angle") +
           pi / 2;
  };
  const double coarse = error("1e-3"), fine = error("5e-4");
  EXPECT_LT(std::abs(coarse), 2e-5);    // (h omega)^2 at the 5.4 rad/s it has there
  EXPECT_NEAR(coarse / fine, 4, 0.02);  // second order: the error vanishes with h^2
}

TEST(Tour, BouncesOfTheBallEndWhereTheGeometricSeriesDoes) {
  const double e = 0.8, g = 9.81;
  const Results results = run("02_bouncing_ball");
  const Event& last = results.events.back();
  ASSERT_EQ(last.kind, "contact_close");
  const double t = last.t, approach = last.detail.at("approach");
  // Flights of 2 e^n approach / g would have followed. Impacts are located to round-off of t; 26 of them add up.
  EXPECT_NEAR(t + 2 * approach / g * e / (1 - e), (1 + e) / (1 - e) * std::sqrt(2 / g), 1e-11);
  EXPECT_NEAR(results.end("y"), 0, 2e-15);    // an impact is located to 1e-15 of the height, and round-off; then a row holds it
  EXPECT_NEAR(results.end("x"), 2.5, 1e-12);  // and free to slide, 5 s at 0.5 m/s
}

TEST(Tour, DoublePendulumKeepsItsEnergyToSecondOrder) {
  const auto worst = [](const char* step) {
    const auto energy = run("03_double_pendulum", {{"integrator.step", step}}).series.at("energy_total");
    return std::abs(
        *std::max_element(energy.begin(), energy.end(), [](double x, double y) { return std::abs(x) < std::abs(y); }));
  };
  const double coarse = worst("5e-4"), fine = worst("2.5e-4");
  EXPECT_LT(coarse, 1e-3);  // of the 10 J that move, (h omega)^2 = 1e-4 at the 20 rad/s of its fastest swings
  EXPECT_NEAR(coarse / fine, 4, 0.1);  // second order
}

TEST(Tour, DrivenSpringFollowsItsClosedForm) {
  // x = L - F/(c omega) cos(omega t) + exp(-c t / 2m) (...) from rest, at resonance.
  const double t = 10, damped = std::sqrt(99.0);
  const double x =
      0.5 - 0.1 * std::cos(10 * t) + std::exp(-t) * 0.1 * (std::cos(damped * t) + std::sin(damped * t) / damped);
  EXPECT_NEAR(run("04_spring_damper").end("x"), x, 1e-8);  // fourth order: (h omega)^4 / 120 times omega t, of 0.1 m
}

TEST(Tour, SliderFollowsTheCrank) {
  const Results results = run("05_slider_crank");
  const double r = 0.1, l = 0.3, omega = 10;
  for (std::size_t i = 0; i < results.series.at("t").size(); ++i) {
    const double phi = omega * results.series.at("t")[i];
    const double x = r * std::cos(phi) + std::sqrt(l * l - r * r * std::sin(phi) * std::sin(phi));
    EXPECT_NEAR(results.series.at("x")[i], x, 1e-12);  // the constraints hold at each step
    EXPECT_NEAR(results.series.at("crank")[i], phi, 1e-12);
  }
}

TEST(Tour, FallingBarOnlyLosesEnergyAndComesToRest) {
  const Results results = run("06_falling_bar");
  const std::vector<double>& energy = results.series.at("energy_total");
  // Fourth order at 1e-5 s in contacts of about 1 ms; the run's balance shows 6e-8 J in all.
  for (std::size_t i = 1; i < energy.size(); ++i) EXPECT_LT(energy[i], energy[i - 1] + 1e-7) << i;
  EXPECT_LT(results.end("energy_kinetic"), 1e-12);
  // At rest each end carries m g / 2: delta = (m g / 2 K)^(2/3).
  EXPECT_NEAR(results.end("left_y"), -std::pow(0.5 * 9.81 / 2 / 1e6, 2.0 / 3), 1e-9);
}

}  // namespace
}  // namespace trammel::test
