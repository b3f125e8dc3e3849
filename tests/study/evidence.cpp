// Verification and ablation, on motions whose answers are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/evidence/ablation.hpp"
#include "study/evidence/verification.hpp"
#include "study/trade/errors.hpp"

namespace trammel::study {
namespace {

const std::string tour = TRAMMEL_SOURCE_DIR "/scenes/tour/";

// Of a run against one with errors a million times smaller.
double true_error(const SceneSource& source, plugin::Registry& registry, const CaseResult& run) {
  const CaseResult exact =
      run_case(source.with({{"integrator", R"({"type": "dop853", "step": {"tolerance": 1e-12}})"}}), registry);
  return Measure(exact, {"angle"}, source.with()).error(run.series, run.series.t.back()).max;
}

class StepOfThePendulum : public testing::TestWithParam<const char*> {};

// Richardson's estimate is exact to the next power of the step: within a tenth at errors below a tenth.
TEST_P(StepOfThePendulum, IsJudgedByItsTrueError) {
  plugin::Registry registry;
  const SceneSource source(tour + "01_pendulum.json", {{"integrator.step", GetParam()}, {"simulate.until", "2"}});
  const CaseResult run = run_case(source.with(), registry);
  const Verification v = verify(source, registry, run, {}, 1e6);
  const ObservableError& angle = v.observables.front();
  ASSERT_EQ(angle.name, "angle");
  const double exact = true_error(source, registry, run);
  EXPECT_NEAR(angle.error / angle.scale / exact, 1, 0.1) << angle.error << " " << angle.reason;
  EXPECT_EQ(v.trusted_until, v.end);
}

INSTANTIATE_TEST_SUITE_P(Lengths, StepOfThePendulum, testing::Values("1e-2", "3e-3", "1e-3"),
                         [](const auto& one) { return "Number" + std::to_string(one.index); });

TEST(Verification, SaysWhetherATargetIsMet) {
  plugin::Registry registry;
  const SceneSource source(tour + "01_pendulum.json", {{"simulate.until", "2"}});
  const CaseResult run = run_case(source.with(), registry);
  EXPECT_TRUE(verify(source, registry, run, 1e-3, 1e6).met());
  EXPECT_FALSE(verify(source, registry, run, 1e-9, 1e6).met());
}

// A double pendulum that swings high parts from any neighbour.
TEST(Verification, EndsTrustWhereRepetitionsPart) {
  plugin::Registry registry;
  const SceneSource source(
      tour + "03_double_pendulum.json",
      {{"integrator", R"({"type": "hht_alpha", "alpha": 0, "step": 1e-2})"}, {"simulate.until", "20"}});
  const CaseResult run = run_case(source.with(), registry);
  ASSERT_TRUE(run.done()) << run.reason;
  const Verification v = verify(source, registry, run, 1e-3, 1e6);
  EXPECT_LT(v.trusted_until, 20);
  EXPECT_FALSE(v.met());
  EXPECT_THAT(v.sentences().front(), testing::HasSubstr("trust ends at t = "));
}

// A spring of no strength beside gravity.
TEST(Ablation, LeavesOutAnIdleSpringAndKeepsGravity) {
  plugin::Registry registry;
  const SceneSource source(
      tour + "01_pendulum.json",
      {{"simulate.until", "1"},
       {"forces",
        R"({"idle": {"type": "spring_damper", "between": ["ground", "bar.tip"], "stiffness": 1e-12, "length": 1}})"}});
  const Ablation a = ablate(source, registry, 1e-6, 1);
  ASSERT_EQ(a.left_out.size(), 1u);
  EXPECT_EQ(a.left_out.front().change.path, "forces.idle");
  const auto gravity =
      std::find_if(a.parts.begin(), a.parts.end(), [](const Part& p) { return p.change.path == "gravity"; });
  ASSERT_NE(gravity, a.parts.end());
  EXPECT_GT(gravity->difference, 0.5);
}

const Part& part_of(const Ablation& a, const std::string& path) {
  return *std::find_if(a.parts.begin(), a.parts.end(), [&](const Part& p) { return p.change.path == path; });
}

// Springs of no strength, written once; the reaction of a joint is of no interest to whom observes the angle alone.
TEST(Ablation, LeavesOutWhatIsRepeatedAtOnceAndKeepsWhatIsObserved) {
  plugin::Registry registry;
  const SceneSource source(
      tour + "01_pendulum.json",
      {{"simulate.until", "1"},
       {"record.observe.reaction", "joints.hinge.reaction"},
       {"forces", R"({"idle_{i}": {"for": {"i": 2}, "type": "spring_damper", "between": ["ground", "bar.tip"],
                                   "stiffness": 1e-12, "length": "=1+{i}"}})"}});
  const Ablation a = ablate(source, registry, 1e-6, 1);
  ASSERT_EQ(a.left_out.size(), 1u);
  EXPECT_EQ(a.left_out.front().change.path, "forces.idle_{i}");
  EXPECT_EQ(part_of(a, "joints.hinge").failure, "it is observed: reaction");
}

}  // namespace
}  // namespace trammel::study
