// Benchmarks with closed forms: pendulums, free bodies and tops.
#include <numbers>

#include "benchmark.hpp"

namespace trammel::test {
namespace {

TEST(BenchmarkA01, MeetsItsReference) {
  const auto data = reference("iftomm_a01_pendulum");
  const Finished run = run_benchmark("a01", {{"record.every", "0.01"}});
  expect_accepted(data, "x(10) m", run.end("x"));
  expect_accepted(data, "y(10) m", run.end("y"));
  expect_accepted(data, "energy drift J", spread(run.series.at("energy_total")));
  const std::vector<double> lowest = zeros(run, "x");  // every half period
  ASSERT_GE(lowest.size(), 8u);
  expect_accepted(data, "period s", (lowest[7] - lowest[1]) / 3);
}

TEST(BenchmarkDoublePendulum, MeetsItsReference) {
  const auto data = reference("double_pendulum");
  const Finished run = run_benchmark("double_pendulum");
  expect_accepted(data, "theta1(5)", at(run, 5, "theta1"));
  expect_accepted(data, "theta2(5)", at(run, 5, "theta2"));
  expect_accepted(data, "theta1(10)", at(run, 10, "theta1"));
  expect_accepted(data, "theta2(10)", at(run, 10, "theta2"));
}

TEST(BenchmarkTorqueFree, MeetsItsReference) {
  const auto data = reference("torque_free_bodies");
  const Finished run = run_benchmark("torque_free");
  expect_accepted(data, "omega1(10)", run.end("omega1"));
  expect_accepted(data, "omega2(10)", run.end("omega2"));
  expect_accepted(data, "quaternion w(10)", run.end("quaternion_w"));
  expect_accepted(data, "relative energy and |L| drift", spread(run.series.at("energy_total")) / 3.875);
  for (const char* component : {"momentum_x", "momentum_y", "momentum_z"})
    expect_accepted(data, "relative energy and |L| drift", spread(run.series.at(component)) / 4.609772228646444);
}

TEST(BenchmarkDzhanibekov, FlipsWhenItsReferenceDoes) {
  const auto data = reference("torque_free_bodies");
  const std::vector<double> flips = zeros(run_benchmark("dzhanibekov"), "omega2");
  ASSERT_EQ(flips.size(), 3u);
  expect_accepted(data, "Dzhanibekov first flip s", flips[0]);
  expect_accepted(data, "Dzhanibekov third flip s", flips[2]);
}

TEST(BenchmarkHeavyTop, MeetsItsReferenceThroughTheDownwardVertical) {
  const auto data = reference("heavy_top");
  const Finished run = run_benchmark("heavy_top");
  expect_accepted(data, "com x(1) m", at(run, 1, "com_x"));
  expect_accepted(data, "com y(1) m", at(run, 1, "com_y"));
  expect_accepted(data, "com z(1) m", at(run, 1, "com_z"));
  expect_accepted(data, "com z(2) m", at(run, 2, "com_z"));
  expect_accepted(data, "omega_body y (constant) rad/s", run.end("omega_body_y"));
}

// Every method: the same top from the same scene. Second order at these steps, 0.1 rad of spin each: phases of the
// nutation are off by (0.1)^2 / 12 per radian of 150; at 0.1 s this is 2e-3 m.
class HeavyTop : public testing::TestWithParam<const char*> {};

TEST_P(HeavyTop, KeepsItsQuaternionOfLengthOneWithoutAConstraint) {
  const Finished run = run_benchmark(
      "heavy_top",
      {{"integrator.type", GetParam()},
       {"integrator.step", "1e-4"},
       {"simulate.until", "0.1"},
       {"record.every", "0.01"},
       {"record.observe.norm", "=top.quaternion_w^2+top.quaternion_x^2+top.quaternion_y^2+top.quaternion_z^2"}});
  const Finished fine = run_benchmark("heavy_top", {{"simulate.until", "0.1"}, {"record.every", "0.01"}});
  for (double norm : run.series.at("norm")) EXPECT_NEAR(norm, 1, 1e-14);  // normalised in each step
  EXPECT_EQ(run.result.at("sizes").at(0).at("nc"), 3);
  for (const char* column : {"com_x", "com_y", "com_z"}) EXPECT_NEAR(run.end(column), fine.end(column), 2e-4) << column;
}

INSTANTIATE_TEST_SUITE_P(Methods, HeavyTop,
                         testing::Values("runge_kutta_4", "dormand_prince", "dop853", "adams_baumgarte", "newmark",
                                         "hht_alpha", "generalized_alpha"));

TEST(BenchmarkCuspidalTop, MeetsItsReference) {
  const auto data = reference("heavy_top");
  const Finished run = run_benchmark("cuspidal_top");
  expect_accepted(data, "cuspidal phi(1) rad", run.end("phi"));
  const auto& theta = run.series.at("theta");
  // The largest recorded value is within theta'' dt^2 / 8 = 1e-5 rad of the largest: look at the parabola through it.
  const std::size_t i = std::size_t(std::max_element(theta.begin(), theta.end()) - theta.begin());
  const double b = (theta[i + 1] - theta[i - 1]) / 2, c = theta[i + 1] - 2 * theta[i] + theta[i - 1];
  expect_accepted(data, "cuspidal theta max deg", (theta[i] - b * b / (2 * c)) * 180 / std::numbers::pi);
  const std::vector<double> turns = zeros(run, "theta_dot");  // lowest, highest, lowest ...
  ASSERT_GE(turns.size(), 21u);
  expect_accepted(data, "cuspidal nutation period s", (turns[20] - turns[0]) / 10);
}

// Richardson extrapolation of two numbers of segments: the error of the segments is of second order.
Finished extrapolated_pendulum(const std::string& which, int segments, const std::string& until) {
  const auto of = [&](int n) {
    return run_benchmark(
        "flexible_pendulum",
        {{"parameters.case", which}, {"parameters.segments", std::to_string(n)}, {"simulate.until", until}});
  };
  const Finished coarse = of(segments);
  Finished fine = of(2 * segments);
  for (const char* column : {"tip_x", "tip_y"})
    for (std::size_t i = 0; i < fine.series.at(column).size(); ++i)
      fine.series.at(column)[i] += (fine.series.at(column)[i] - coarse.series.at(column).at(i)) / 3;
  return fine;
}

TEST(BenchmarkFlexiblePendulum, MeetsItsReference) {
  const auto data = reference("flexible_pendulum");
  const Finished run = extrapolated_pendulum("moderate", 12, "2");
  expect_accepted(data, "moderate x(1)", at(run, 1, "tip_x"));
  expect_accepted(data, "moderate y(1)", at(run, 1, "tip_y"));
  expect_accepted(data, "moderate x(2)", at(run, 2, "tip_x"));
  expect_accepted(data, "moderate y(2)", at(run, 2, "tip_y"));
}

TEST(BenchmarkFlexiblePendulum, MeetsItsReferenceWhenVerySoft) {
  const auto data = reference("flexible_pendulum");
  const Finished run = extrapolated_pendulum("soft", 96, "0.6");
  expect_accepted(data, "soft x(0.5)", at(run, 0.5, "tip_x"));
  expect_accepted(data, "soft y(0.5)", at(run, 0.5, "tip_y"));
  expect_accepted(data, "soft x(0.6)", at(run, 0.6, "tip_x"));
}

// To 2 s the scene takes ten seconds; there it is off by 1.7e-5.
TEST(BenchmarkFlexiblePendulum, BeginsAsItsReferenceDoes) {
  const auto data = reference("flexible_pendulum");
  const Finished run = run_benchmark("flexible_pendulum", {{"simulate.until", "0.3"}});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = data.at("reference").at("moderate").at(i);
    EXPECT_NEAR(at(run, row[0], "tip_x"), row[1].get<double>(), 1e-5);
    EXPECT_NEAR(at(run, row[0], "tip_y"), row[2].get<double>(), 1e-5);
  }
}

}  // namespace
}  // namespace trammel::test
