// Benchmarks of impacts.
#include "benchmark.hpp"

namespace trammel::test {
namespace {

TEST(BenchmarkBouncingBall, StrikesAndRestsWhenItsReferenceDoes) {
  const auto data = reference("bouncing_ball");
  const Finished run = run_benchmark("bouncing_ball");
  const std::vector<Event> impacts = run.of_kind("impact");
  const auto& times = data.at("reference").at("impact_times_s");
  ASSERT_GT(impacts.size(), times.size());
  for (std::size_t n = 0; n < times.size(); ++n)
    EXPECT_NEAR(impacts[n].t, std::stod(times[n].get<std::string>()), 1e-11) << n;  // located to round-off
  ASSERT_EQ(run.of_kind("contact_close").size(), 1u);
  expect_accepted(data, "Zeno time s", run.of_kind("contact_close")[0].t);
}

TEST(BenchmarkHertz, MeetsItsReference) {
  const auto data = reference("hertz_impact");
  const Finished run = run_benchmark("hertz");
  const auto& force = run.series.at("force");
  const auto& gap = run.series.at("gap");
  const double deepest = -*std::min_element(gap.begin(), gap.end());
  expect_accepted(data, "F_max N", *std::max_element(force.begin(), force.end()));
  ASSERT_EQ(run.of_kind("contact_close").size(), 1u);
  ASSERT_EQ(run.of_kind("contact_open").size(), 1u);
  const double T = run.of_kind("contact_open")[0].t - run.of_kind("contact_close")[0].t;
  expect_accepted(data, "steel R10 v1 rigid plane: T s", T);
  expect_accepted(data, "T v0/delta_max", T / deepest);
  expect_accepted(data, "restitution", run.end("vy"));
}

TEST(BenchmarkNewtonsCradle, IsNotTheIdealOneWhenItsBallsTouch) {
  const auto data = reference("newtons_cradle");
  const Finished three = run_benchmark("newtons_cradle_3");
  expect_accepted(data, "Hertz n=3 v3", three.end("v3"));
  expect_accepted(data, "Hertz n=3 v1", three.end("v1"));
  const Finished five = run_benchmark("newtons_cradle_5");
  expect_accepted(data, "Hertz n=5 v5", five.end("v5"));
  const auto& speeds = data.at("reference").at("hertz_chain_touching_m=k=v=1").at("n=5_final_velocities");
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(five.end("v" + std::to_string(i + 1)), speeds[i].get<double>(), 1e-8);  // digits of the data
}

}  // namespace
}  // namespace trammel::test
