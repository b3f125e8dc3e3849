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

TEST(BenchmarkRockingBlock, MeetsItsReference) {
  const auto data = reference("rocking_block");
  const Finished run = run_benchmark("rocking_block");
  const std::vector<Event> impacts = run.of_kind("impact");
  const auto& times = data.at("reference").at("exact_impact_times_s");
  ASSERT_EQ(impacts.size(), times.size());
  for (std::size_t n = 0; n < times.size(); ++n)
    EXPECT_NEAR(impacts[n].t, std::stod(times[n].get<std::string>()), 1e-9) << n;  // the data's own acceptance is 1e-5
  expect_accepted(data, "first impact s", impacts[0].t);
  expect_accepted(data, "third impact s", impacts[2].t);

  // Of the corners' speeds: that struck before, that left after.
  const std::vector<Event> leaves = run.of_kind("contact_open");
  ASSERT_GE(leaves.size(), 2u);
  expect_accepted(data, "velocity restitution r", leaves[0].detail.at("separation") / impacts[0].detail.at("approach"));
  double peak = 0;
  for (std::size_t i = 0; i < run.series.at("t").size(); ++i)
    if (run.series.at("t")[i] > impacts[0].t && run.series.at("t")[i] < impacts[1].t)
      peak = std::max(peak, std::abs(run.series.at("theta")[i]));
  expect_accepted(data, "second peak angle rad", peak);
}

// Where evenly spaced samples are largest: the top of the parabola through the largest and its neighbours.
struct Peak {
  double t, value;
};
Peak peak_of(const Finished& run, const std::string& column) {
  const auto &t = run.series.at("t"), &y = run.series.at(column);
  const auto i = std::size_t(std::max_element(y.begin(), y.end()) - y.begin());
  const double slope = (y[i + 1] - y[i - 1]) / 2, bend = y[i + 1] - 2 * y[i] + y[i - 1];
  return {t[i] - slope / bend * (t[i + 1] - t[i]), y[i] - slope * slope / (2 * bend)};
}

TEST(BenchmarkTimoshenko, FirstCaseMeetsItsReference) {
  const auto data = reference("timoshenko_sphere_on_beam");
  const Finished run = run_benchmark("timoshenko_1");
  const Peak peak = peak_of(run, "force");
  expect_accepted(data, "case 1 F_max N", peak.value);
  expect_accepted(data, "case 1 t(F_max) s", peak.t);
  ASSERT_EQ(run.of_kind("contact_open").size(), 1u);
  expect_accepted(data, "case 1 contact end s", run.of_kind("contact_open")[0].t);
  expect_accepted(data, "case 1 sphere velocity after m/s", -run.end("ball_vy"));  // positive towards the beam there
  for (const auto& sample : data.at("reference").at("case1").at("t_F_wmid_samples")) {
    const double w = sample[2];
    // The samples' own digits, and 30 modes of the cantilever for those of the simply supported beam.
    EXPECT_NEAR(-at(run, sample[0], "w"), w, 2e-9) << sample[0];
    EXPECT_NEAR(at(run, sample[0], "force"), sample[1].get<double>(), 0.02) << sample[0];
  }
}

// The sphere and the odd modes sin(j pi x / L) of the simply supported beam, by fixed steps of Runge-Kutta: nothing in
// common with the scene but the equations.
struct Touches {
  std::vector<double> close, open;
  double speed = 0;  // of the sphere at the end, away from the beam
};
Touches by_simply_supported_modes(int modes, double until) {
  const double L = 0.307, R = 0.02, E = 215.7463e9, rho = 7960, a = 0.01, pi = std::acos(-1.0);
  const double m = rho * 4 / 3 * pi * R * R * R, k = 4.0 / 3 * std::sqrt(R) * E / (2 * (1 - 0.09));
  const Eigen::Index n = modes;
  Vec omega2(n), middle(n);
  for (int i = 0; i < modes; ++i) {
    const double j = 2 * i + 1;
    omega2(i) = std::pow(j * pi / L, 4) * E * std::pow(a, 4) / 12 / (rho * a * a);
    middle(i) = i % 2 ? -1 : 1;
  }
  double force = 0;
  const auto rate = [&](const Vec& y) {
    const double depth = y(2 * n) - middle.dot(y.head(n));
    force = depth > 0 ? k * std::pow(depth, 1.5) : 0;
    Vec r(2 * n + 2);
    r << y.segment(n, n), Vec(-omega2.cwiseProduct(y.head(n)) + 2 / (rho * a * a * L) * force * middle), y(2 * n + 1),
        -force / m;
    return r;
  };
  Vec y = Vec::Zero(2 * n + 2);
  y(2 * n + 1) = 0.01;
  Touches found;
  const double h = 1 / std::sqrt(omega2(n - 1));
  bool touching = false;
  for (double t = 0; t < until; t += h) {
    const Vec k1 = rate(y);
    if ((force > 0) != touching) (touching ? found.open : found.close).push_back(t), touching = !touching;
    const Vec k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2), k4 = rate(y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  found.speed = -y(2 * n + 1);
  return found;
}

TEST(BenchmarkTimoshenko, SecondCaseTouchesThreeTimes) {
  const Finished run = run_benchmark("timoshenko_2");
  const Touches other = by_simply_supported_modes(24, 0.004);
  const std::vector<Event> close = run.of_kind("contact_close"), open = run.of_kind("contact_open");
  ASSERT_EQ(close.size(), 3u);
  ASSERT_EQ(open.size(), 3u);
  ASSERT_EQ(other.close.size(), 3u);
  ASSERT_EQ(other.open.size(), 3u);
  // Between 24 and 40 modes of either kind the times move by 0.5 us, the speed by 1e-6 m/s.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(close[i].t, other.close[i], 2e-6) << i;
    EXPECT_NEAR(open[i].t, other.open[i], 2e-6) << i;
  }
  EXPECT_NEAR(run.end("ball_vy"), other.speed, 5e-6);
}

TEST(BenchmarkRodOnWall, LeavesAsFastAsItCame) {
  const auto data = reference("rod_on_wall");
  const Finished run = run_benchmark("rod_on_wall");
  const auto expected = [&](std::size_t i) { return data.at("acceptance").at(i).at("value").get<double>(); };
  const double end = run.of_kind("contact_open").back().t;
  EXPECT_NEAR(end, expected(0), 0.01 * expected(0));
  // Of the plateau without its ends, where the series' ripple is largest.
  const auto &t = run.series.at("t"), &force = run.series.at("force");
  double sum = 0, samples = 0, impulse = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] > 0.1 * end && t[i] < 0.9 * end) sum += force[i], ++samples;
    if (i > 0) impulse += (t[i] - t[i - 1]) * (force[i] + force[i - 1]) / 2;
  }
  for (const Event& impact : run.of_kind("impact")) impulse += impact.detail.at("impulse");
  EXPECT_NEAR(sum / samples, expected(1), 0.01 * expected(1));
  EXPECT_NEAR(impulse, expected(2), 0.005 * expected(2));
  EXPECT_NEAR(-run.end("com_vx"), expected(3), data.at("acceptance").at(3).at("abs_tol").get<double>());
}

}  // namespace
}  // namespace trammel::test
