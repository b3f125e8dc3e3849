#include "study/cases/case_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/cases/batch.hpp"
#include "support/made.hpp"
#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::study {
namespace {

scene::Scene with(const std::string& text, const std::vector<scene::Override>& overrides = {}) {
  return scene::Scene::parse(text, "test.json", overrides);
}

TEST(CaseRun, GivesTheNumbersThatARunWrites) {
  const test::Finished written = test::run_text(test::ball);
  plugin::Registry& registry = test::registry();
  const CaseResult r = run_case(with(test::ball), registry);
  ASSERT_TRUE(r.done()) << r.reason;
  for (const char* name : {"x", "y", "force"}) {
    const std::size_t column = r.series.column(name).value();
    ASSERT_EQ(r.series.rows(), written.series.at(name).size());
    for (std::size_t i = 0; i < r.series.rows(); ++i) EXPECT_EQ(r.series.at(i, column), written.series.at(name)[i]);
  }
  EXPECT_EQ(r.counts.impacts, written.result["counts"]["impacts"].get<long long>());
  EXPECT_EQ(r.counts.evaluations, written.result["counts"]["residual_evaluations"].get<long long>());
}

TEST(CaseRun, OfAWrongSceneIsAResultWithItsReason) {
  plugin::Registry& registry = test::registry();
  const CaseResult r = run_case(with(test::ball, {{"bodies.ball.mass", "-1"}}), registry);
  EXPECT_EQ(r.status, CaseResult::Status::refused);
  EXPECT_THAT(r.reason, testing::HasSubstr("bodies.ball.mass"));
}

TEST(CaseRun, EndsAtItsLimitOfTime) {
  plugin::Registry& registry = test::registry();
  CaseOptions options;
  options.cpu_limit = 0.02;
  const CaseResult r = run_case(with(test::oscillator, {{"integrator.step", "1e-6"}}), registry, options);
  EXPECT_EQ(r.status, CaseResult::Status::too_long);
  EXPECT_GT(r.series.rows(), 0u);
  EXPECT_LT(r.cpu, 1);
}

TEST(CaseRun, ComesThroughAPipeAsItWas) {
  plugin::Registry& registry = test::registry();
  const CaseResult r = run_case(with(test::ball), registry), back = unpacked(packed(r));
  EXPECT_EQ(back.series.t, r.series.t);
  EXPECT_EQ(back.series.values, r.series.values);
  EXPECT_EQ(back.events.size(), r.events.size());
  EXPECT_EQ(back.counts.newton_iterations, r.counts.newton_iterations);
  EXPECT_EQ(back.scene_hash, r.scene_hash);
}

TEST(CaseRun, OfAPerturbedStartDiffersByAsMuch) {
  plugin::Registry& registry = test::registry();
  CaseOptions perturbed;
  perturbed.perturbation = 1e-6;
  const scene::Scene scene = with(test::ball, {{"simulate.until", "0.4"}});
  const CaseResult a = run_case(scene, registry), b = run_case(scene, registry, perturbed);
  const std::size_t y = a.series.column("y").value(), last = a.series.rows() - 1;
  // v = (0.5, 0) is moved by 1e-6 times 0.5 m/s along gravity.
  EXPECT_NEAR(a.series.at(last, y) - b.series.at(last, y), 0.4 * 0.5e-6, 1e-9);
}

}  // namespace
}  // namespace trammel::study
