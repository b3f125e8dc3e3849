// Joints that count turns (CountsTurns): a nut that falls along its screw by many turns.
#include <cmath>

#include <fmt/format.h>

#include "support/run_in_pieces.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

// m z'' (1 + J (2 pi/p)^2/m) = -m g: with J = 1e-4 kg m^2 and p = 0.02 m 22 turns in a second.
std::string nut(const std::string& integrator) {
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
    "plugins": ["{}/tests/plugins/screw.so"],
    "bodies": {{"nut": {{"type": "rigid_body", "mass": 1, "inertia": [1e-4, 1e-4, 1e-4]}}}},
    "joints": {{"guide": {{"type": "cylindrical", "between": ["ground", "nut.com"]}},
               "thread": {{"type": "screw", "between": ["ground", "nut.com"], "lead": 0.02}}}},
    "integrator": {}, "simulate": {{"until": 1}}, "record": {{"every": 0.05, "observe": {{"z": "nut.com.z"}}}}}})",
                     TRAMMEL_BUILD_DIR, integrator);
}

double place(double t) {
  const double turn = 2 * EIGEN_PI / 0.02;
  return -9.81 * t * t / (2 * (1 + 1e-4 * turn * turn));
}

class Screw : public testing::TestWithParam<Method> {};

TEST_P(Screw, TurnsManyTimesAsItFallsAndAlsoWhenResumed) {
  const scene::Scene scene = scene::Scene::parse(nut(GetParam().json), "test.json");
  const Finished run = run_scene(scene);
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (std::size_t i = 0; i < run.series.at("t").size(); ++i)
    // Constant acceleration is exact for every method; steps that take the quaternion as numbers err in the angle by (h
    // omega)^4 of fourth order, h omega = 0.28 at the end, and g with Baumgarte's terms follows: p/(2 pi) times 6e-3
    // rad, less than a tenth of it.
    EXPECT_NEAR(run.series.at("z")[i], place(run.series.at("t")[i]), 2e-6);
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 61);
  EXPECT_GT(pieces.steps, 61);
  EXPECT_TRUE(pieces.series == whole.series);
  EXPECT_EQ(pieces.data, whole.data);
}
INSTANTIATE_TEST_SUITE_P(With, Screw, testing::ValuesIn(fixed_methods("1e-3")), method_name);

TEST(ScrewByErrorControl, IsAsExactAsItsTolerance) {
  const Finished run = run_text(nut(R"({"type": "dop853", "step": {"tolerance": 1e-10}})"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_NEAR(run.end("z"), place(1), 1e-8);
}

}  // namespace
}  // namespace trammel::test
