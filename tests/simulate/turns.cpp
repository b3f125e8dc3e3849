// Springs between axes of bodies count full turns, in space as in the plane.
#include <cmath>

#include "support/run_in_pieces.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

// omega = 3 rad/s: amplitude 8 rad.
const char* const wheel = R"({"trammel": 1, "space": "spatial",
  "bodies": {"wheel": {"type": "rigid_body", "mass": 1, "inertia": [2, 2, 2], "angular_velocity": [0, 0, 24]}},
  "joints": {"axle": {"type": "revolute", "between": ["ground", "wheel.com"]}},
  "forces": {"spring": {"type": "torsional_spring", "between": ["ground", "wheel.com"], "stiffness": 18}},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-10}},
  "simulate": {"until": 2},
  "record": {"every": 0.05, "observe": {"rate": "wheel.com.omega_z", "stored": "energy.elastic"}}})";
const Overrides bushing = {
    {"forces.spring", R"({"type": "bushing", "between": ["ground", "wheel.com"], "torsional_stiffness": [5, 7, 18]})"}};

// Largest error of the rate of a wheel that begins with `rate` at rest of its spring.
double error_of(const Finished& run, double rate) {
  double largest = 0;
  for (std::size_t i = 0; i < run.series.at("t").size(); ++i)
    largest = std::max(largest, std::abs(run.series.at("rate")[i] - rate * std::cos(3 * run.series.at("t")[i])));
  return largest;
}

TEST(TorsionalSpringInSpace, SwingsByMoreThanATurn) {
  const Finished run = run_text(wheel);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(error_of(run, 24), 1e-7);  // 100 times the tolerance, of 24 rad/s
}

class TurnsBy : public testing::TestWithParam<Method> {};
TEST_P(TurnsBy, EveryMethodAndAlsoWhenResumed) {
  const scene::Scene scene = scene::Scene::parse(wheel, "test.json", {{"integrator", GetParam().json}});
  const Finished run = run_scene(scene);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(error_of(run, 24), 0.2);  // of second order with h omega = 0.006; snapping over half a turn gives 20
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 37);
  EXPECT_TRUE(pieces.series == whole.series);
}
INSTANTIATE_TEST_SUITE_P(With, TurnsBy, testing::ValuesIn(fixed_methods("2e-3")), method_name);

TEST(TorsionalSpringInSpace, IsPreloadedByMoreThanATurn) {
  const Finished run = run_text(wheel, {{"forces.spring.angle", "10"}, {"bodies.wheel.angular_velocity", "[0, 0, 0]"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.series.at("stored").front(), 18 * 100 / 2.0, 1e-10);
  for (std::size_t i = 0; i < run.series.at("t").size(); ++i)
    EXPECT_NEAR(run.series.at("rate")[i], 30 * std::sin(3 * run.series.at("t")[i]), 1e-7);
}

TEST(TorsionalSpringInSpace, IsWoundUpByStatics) {
  const Finished run =
      run_static(wheel, {{"forces.winding", R"({"type": "load", "on": "wheel.com", "torque": {"z": "=180*t"}})"},
                         {"simulate.until", "1"},
                         {"static", R"({"steps": 10})"}});
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("stored"), 18 * 100 / 2.0, 1e-7);
}

TEST(BushingInSpace, SwingsByMoreThanHalfATurn) {
  Overrides slower = bushing;
  slower.push_back({"bodies.wheel.angular_velocity", "[0, 0, 18]"});
  const Finished run = run_text(wheel, slower);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(error_of(run, 18), 1e-7);
}

TEST(BushingInSpace, EndsTheRunAtAFullTurn) {
  const Finished run = run_text(wheel, bushing);
  EXPECT_EQ(run.report.status, simulate::Status::failed);
  EXPECT_NE(run.report.reason.find("forces.spring: B has turned by a full turn against A"), std::string::npos)
      << run.report.reason;
  EXPECT_NEAR(run.end("t"), std::asin(2 * EIGEN_PI / 8) / 3, 0.1);  // the row before, and a step after it
}

}  // namespace
}  // namespace trammel::test
