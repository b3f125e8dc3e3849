// A contact that lifts at its impact and falls back within the same step: the run once stood still here, by steps of
// 1e-15 s.
#include <filesystem>

#include <gtest/gtest.h>

#include "scene/value.hpp"
#include "commands/simulation.hpp"

#include "support/made.hpp"

namespace trammel::test {
namespace {

TEST(BeamImpact, GoesOnWhereTheTipLiftsAndFallsBackWithinAStep) {
  const scene::Scene scene =
      scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/beam_impact/table_1_hht.json",
                         {{"parameters.N", "3"}, {"parameters.alpha", "=-1/3"}, {"simulate.until", "1.21"}});
  simulate::RunOptions options;
  options.out = testing::TempDir() + "lift";
  const simulate::RunReport report = simulate::run(scene, registry(), options);
  EXPECT_EQ(report.status, simulate::Status::done) << report.reason;
  std::filesystem::remove_all(options.out);
}

}  // namespace
}  // namespace trammel::test
