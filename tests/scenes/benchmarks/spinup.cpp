// A beam that is spun up: foreshortening stiffens it.
#include "benchmark.hpp"

namespace trammel::test {
namespace {

// The beam's foreshortening is of second order, so its deflection is off by (v/L)^2 = 0.3 % of itself: the data's own
// note gives such models one per cent. It is that model, not the step or the modes: 8 modes and 5e-4 s change v by 4e-5
// m.
TEST(BenchmarkSpinup, BendsAndStretchesAsItsReferenceDoes) {
  const auto data = reference("spinup_beam");
  const Finished run = run_benchmark("spinup_simo");
  const auto& v = run.series.at("v");
  const auto least = std::min_element(v.begin(), v.end());
  EXPECT_NEAR(*least, -0.573835, 0.00574);
  expect_accepted(data, "Simo: time of minimum s", run.series.at("t")[std::size_t(least - v.begin())]);
  expect_accepted(data, "Simo: v(5) m", at(run, 5, "v"));
  expect_accepted(data, "Simo: v(10) m", at(run, 10, "v"));
  expect_accepted(data, "Simo: u(20) m", run.end("u"));
  for (std::size_t i = 0; i < v.size(); ++i)
    if (run.series.at("t")[i] > 15) {
      EXPECT_LT(std::abs(v[i]), 0.00574) << run.series.at("t")[i];
    }
}

TEST(BenchmarkSpinup, WithoutForeshorteningTheBeamRunsAwayAndIsStopped) {
  // The linear beam loses all stiffness at its first bending frequency, 3.516 sqrt(EI/(rho A L^4)) = 3.8 rad/s, reached
  // at 9 s.
  const Finished run =
      run_file("benchmarks/spinup_simo.json", {{"bodies.beam.coupling", "linear"}, {"simulate.until", "10"}});
  ASSERT_FALSE(run.done());
  EXPECT_NE(run.report.reason.find("bodies.beam cannot have this shape"), std::string::npos) << run.report.reason;
  EXPECT_NEAR(run.result["t_end"].get<double>(), 9, 0.1);
  EXPECT_GT(std::abs(run.end("v")), 5);  // half the length of the beam
}

}  // namespace
}  // namespace trammel::test
