// Rows are written at start + k every, exactly, whatever the steps and events do.
#include <algorithm>
#include <cmath>
#include <ctime>

#include "simulate/start/setup.hpp"
#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

class RecordTimes : public testing::TestWithParam<Method> {};

TEST_P(RecordTimes, AreMultiplesBitForBit) {
  const Finished run = run_text(ball, {{"integrator", GetParam().json}, {"record.every", "0.1"}});
  const std::vector<double>& t = run.series.at("t");
  ASSERT_EQ(t.size(), 21u);
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_EQ(t[k], double(k) * 0.1) << k;
}

TEST_P(RecordTimes, DoNotDependOnWhereTheRunStartsOrEnds) {
  const Finished run = run_text(ball, {{"integrator", GetParam().json},
                                       {"simulate.start", "-0.3"},
                                       {"simulate.until", "1.234"},
                                       {"record.every", "0.07"}});
  const std::vector<double>& t = run.series.at("t");
  ASSERT_EQ(t.size(), 23u);
  for (std::size_t k = 0; k + 1 < t.size(); ++k) EXPECT_EQ(t[k], -0.3 + double(k) * 0.07) << k;
  EXPECT_EQ(t.back(), 1.234);  // the end has a row of its own
}

TEST_P(RecordTimes, HoldTheStateAtThatTime) {
  const Finished run = run_text(ball, {{"integrator", GetParam().json}, {"record.every", "0.013"}});
  const std::vector<double>&t = run.series.at("t"), &y = run.series.at("y");
  for (std::size_t k = 0; k < t.size() && t[k] < std::sqrt(0.2); ++k)
    EXPECT_NEAR(y[k], 1 - 5 * t[k] * t[k], 1e-12) << k;  // round-off of the steps
}

std::vector<Method> all_methods() {
  std::vector<Method> methods = fixed_methods("0.03");  // divides neither 0.1 nor 0.07
  for (const Method& method : controlled_methods("1e-9")) methods.push_back(method);
  return methods;
}
INSTANTIATE_TEST_SUITE_P(Of, RecordTimes, testing::ValuesIn(all_methods()), method_name);

TEST(ARunOfZeroLength, WritesOneRowAndIsDone) {
  const Finished run = run_text(ball, {{"simulate.until", "0"}});
  EXPECT_TRUE(run.done());
  ASSERT_EQ(run.series.at("t").size(), 1u);
  EXPECT_EQ(run.end("y"), 1);
  EXPECT_EQ(run.result["counts"]["steps"], 0);
}

// A rod's row is (|x|^2/L - L)/2; explicit steps let it drift. With a row of the series each step.
TEST(ConstraintNorms, AreThoseOfTheRowsAndTheirMaximaThoseOfAllSteps) {
  const Finished run = run_text(R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
    "bodies": {"bob": {"type": "point_mass", "mass": 1, "position": [1, 0]}},
    "joints": {"rod": {"type": "distance", "between": ["ground", "bob.point"], "length": 1}},
    "integrator": {"type": "runge_kutta_4", "step": 0.05}, "simulate": {"until": 2},
    "record": {"every": 0.05, "observe": {"x": "bob.point.x", "y": "bob.point.y", "vx": "bob.point.vx",
                                          "vy": "bob.point.vy"}}})");
  ASSERT_TRUE(run.done()) << run.report.reason;
  const auto column = [&run](const char* name) -> const std::vector<double>& { return run.series.at(name); };
  const std::vector<double>&x = column("x"), &y = column("y"), &vx = column("vx"), &vy = column("vy");
  ASSERT_EQ(x.size(), 41u);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(column("constraint_position")[i], std::abs(x[i] * x[i] + y[i] * y[i] - 1) / 2, 1e-15);
    EXPECT_NEAR(column("constraint_velocity")[i], std::abs(x[i] * vx[i] + y[i] * vy[i]), 1e-14);
  }
  for (const std::string name : {"position", "velocity", "acceleration"}) {
    const std::vector<double>& norms = column(("constraint_" + name).c_str());
    const double largest = *std::max_element(norms.begin(), norms.end());
    EXPECT_GT(largest, 0) << name;
    EXPECT_EQ(run.result["constraint_maxima"][name], largest) << name;
  }
}

TEST(ResultsFolder, ThatCannotBeMadeIsNamedWithTheReason) {
  const Folder folder;
  std::filesystem::create_directories(folder.path());
  std::ofstream(folder.path() / "file") << "not a folder";
  simulate::RunOptions options;
  options.out = folder.path() / "file" / "results";
  const simulate::RunReport report = simulate::run(scene::Scene::parse(ball, "test.json"), registry(), options);
  EXPECT_EQ(report.status, simulate::Status::failed);
  EXPECT_NE(report.reason.find((folder.path() / "file" / "results").string()), std::string::npos) << report.reason;
  EXPECT_NE(report.reason.find("Not a directory"), std::string::npos) << report.reason;
}

// All names are made for a message only: four times the markers take four times as long, not sixteen times.
TEST(Observe, IsReadInTimeProportionalToTheMarkers) {
  const auto seconds = [](int count) {
    std::string markers;
    for (int i = 0; i < count; ++i) markers += fmt::format("{}\"a_marker_of_number_{}\": [0, 0]", i ? ", " : "", i);
    const scene::Scene scene = scene::Scene::parse(
        R"({"trammel": 1, "space": "planar", "bodies": {"b": {"type": "rigid_body", "mass": 1, "inertia": 1, "markers": {)" +
            markers + R"(}}}, "simulate": {"until": 1}, "record": {"observe": {"x": "b.com.x"}}})",
        "test.json");
    const std::clock_t begin = std::clock();
    simulate::set_up(scene, registry());
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  const double few = seconds(10000);
  EXPECT_LT(seconds(40000), 8 * few + 0.1);  // half way between in the exponent; a clock's tick
}

}  // namespace
}  // namespace trammel::test
