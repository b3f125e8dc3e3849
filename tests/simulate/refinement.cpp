// Bodies that replace their coordinates during a run: with every integrator, at a time or at a contact, cut and
// resumed.
#include <cmath>

#include <fmt/format.h>

#include "support/run_in_pieces.hpp"
#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

// Vibrates and flies, refined at 0.1 s. A step is an eighth of the period of the finer mesh's fastest mode,
// 2 pi/(sqrt(12) c/(length/8)) = 0.023 s with c = 10 m/s, or less.
std::string scene(const std::string& body, const std::string& more, const std::string& integrator) {
  return fmt::format(R"({{
    "trammel": 1, "space": "planar", "gravity": [0, 0], "plugins": ["{}/tests/plugins/refining_bar.so"],
    "bodies": {{"bar": {{"type": "refining_bar", {}}}}}, {}
    "integrator": {}, "simulate": {{"until": 0.3}},
    "record": {{"every": 0.05, "observe": {{"left": "bar.left.x", "right": "bar.right.x"}}}}}})",
                     TRAMMEL_BUILD_DIR, body, more, integrator);
}
std::string flying(const std::string& integrator) {
  return scene(R"("speed": 0.5, "stretch": 0.1, "at_time": 0.1)", "", integrator);
}
const std::string wall = R"("contacts": {"wall": {"type": "constraint_method", "restitution": 0,
  "between": ["bar.left", {"plane": {"point": [0.9, 0], "normal": [1, 0]}}]}},)";
std::string struck(const std::string& integrator) {
  return scene(R"("speed": -1, "at_contact": "wall")", wall, integrator);
}

const std::string rk4 = R"({"type": "runge_kutta_4", "step": 1e-3})";

Event refinement(const Finished& run) {
  const auto found = run.of_kind("refine");
  return found.size() == 1 ? found.front() : Event{};
}

class Refined : public testing::TestWithParam<Method> {};

TEST_P(Refined, BarKeepsItsMassMomentumAndEnergy) {
  const Event event = refinement(run_text(flying(GetParam().json)));
  ASSERT_EQ(event.kind, "refine");
  for (const char* what : {"mass", "momentum_x", "kinetic", "elastic"}) {
    const double before = event.detail.at(std::string(what) + "_before");
    // Round-off of sums over 8 elements of terms of the size of the sum.
    EXPECT_NEAR(event.detail.at(std::string(what) + "_after"), before, 1e-13 * std::abs(before)) << what;
  }
  EXPECT_EQ(event.detail.at("coordinates_before"), 5);
  EXPECT_EQ(event.detail.at("coordinates_after"), 9);
}

TEST_P(Refined, CentreFliesOnAsIfNothingHadHappened) {
  const Finished run = run_text(flying(GetParam().json));
  ASSERT_TRUE(run.done()) << run.report.reason;
  // No force acts on the whole bar and its vibration is symmetric, so the middle between the ends moves uniformly.
  // Every method is exact for that; 1e-11 is the implicit ones' iteration over 300 steps.
  EXPECT_NEAR(0.5 * (run.end("left") + run.end("right")), 1 + 0.55 + 0.5 * 0.3, 1e-11);
}

TEST_P(Refined, RunEndsWithTheSameBytesWhenCutAndResumed) {
  const auto bar = scene::Scene::parse(struck(GetParam().json), "test.json");
  const Logs whole = run_in_pieces(bar, 1LL << 60), pieces = run_in_pieces(bar, 17);
  EXPECT_NE(whole.events.find(",refine,"), std::string::npos);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
}

INSTANTIATE_TEST_SUITE_P(ByEachIntegrator, Refined, testing::ValuesIn(fixed_methods("1e-3")), method_name);

TEST(Refinement, HappensAtTheFirstStepsEndFromItsTime) {
  EXPECT_NEAR(refinement(run_text(flying(rk4))).t, 0.1, 1e-3);
}

TEST(Refinement, HappensAtTheInstantOfTheContactThatCausesIt) {
  const Finished run = run_text(struck(rk4));
  const auto impacts = run.of_kind("impact");
  ASSERT_FALSE(impacts.empty());
  EXPECT_EQ(refinement(run).t, impacts.front().t);
}

TEST(Refinement, ThatGivesNoNumbersEndsTheRunAndIsNamed) {
  for (const char* spoils : {"q", "v"}) {
    const Finished run = run_text(
        scene(fmt::format(R"("speed": 0.5, "stretch": 0.1, "at_time": 0.1, "spoils": "{}")", spoils), "", rk4));
    EXPECT_EQ(run.report.status, simulate::Status::failed) << spoils;
    EXPECT_NE(run.report.reason.find("the refinement of bar gave numbers that are not finite"), std::string::npos)
        << run.report.reason;
  }
}

TEST(Refinement, IsReportedWithTheSizesInTheResult) {
  const Finished run = run_text(flying(rk4));
  const auto sizes = run.result.at("sizes");
  EXPECT_EQ(sizes.front().at("nq"), 5);
  EXPECT_EQ(sizes.back().at("nq"), 9);
  EXPECT_NEAR(run.result.at("energy_of_refinements").get<double>(), 0, 1e-14);
}

// Until it touches the bar moves without strain, which any mesh holds exactly: from the touch on it must be the finer
// bar.
TEST(Refinement, AtATouchGivesTheMotionOfABarThatWasFineFromTheStart) {
  const std::string soft_wall = R"("contacts": {"wall": {"type": "continuous_force", "stiffness": 1e4, "exponent": 1.5,
    "restitution": 0.8, "between": ["bar.left", {"plane": {"point": [0.9, 0], "normal": [1, 0]}}]}},)";
  const auto end = [&](const std::string& body) {
    const Finished run = run_text(scene(body, soft_wall, R"({"type": "dop853", "step": {"tolerance": 1e-11}})"));
    return run.end("right") - run.end("left");
  };
  const double fine = end(R"("elements": 8, "speed": -1)");
  const double refined = end(R"("elements": 4, "speed": -1, "at_contact": "wall")");
  const double coarse = end(R"("elements": 4, "speed": -1)");
  EXPECT_NEAR(refined, fine, 1e-9);  // a hundred steps at 1e-11
  EXPECT_GT(std::abs(coarse - fine), 1e-5);
}

}  // namespace
}  // namespace trammel::test
