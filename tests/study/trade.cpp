#include "study/trade/trade.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/made.hpp"
#include "support/run_scene.hpp"

namespace trammel::study {
namespace {

using nlohmann::json;

// A mass on a spring: y - 1 = cos t, known at all times.
const std::string swing = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"mass": {"type": "point_mass", "mass": 1, "position": [0, 2]}},
  "forces": {"spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 1, "length": 1}},
  "integrator": {"type": "hht_alpha", "step": 1e-3},
  "simulate": {"until": 10},
  "record": {"every": 0.1, "observe": {"y": "mass.point.y"}}
})";

struct Traded {
  test::Folder folder;
  TradeReport report;
  std::string scene = folder.path() / "swing.json";

  explicit Traded(double target) {
    std::filesystem::create_directories(folder.path());
    std::ofstream(scene) << swing;
    plugin::Registry& registry = test::registry();
    TradeOptions options;
    options.out = folder.path(), options.target = target, options.budget = 20;
    const SceneSource source(scene);
    report = trade(source, registry, options);
  }
};

double largest_error(const CaseResult& r) {
  double most = 0;
  for (std::size_t i = 0; i < r.series.rows(); ++i)
    most = std::max(most, std::abs(r.series.at(i, 0) - 1 - std::cos(r.series.t[i])));
  return most;
}

TEST(Trade, NamesAChoiceWhoseErrorIsTrulyBelowTheTarget) {
  const Traded traded(1e-6);
  ASSERT_TRUE(traded.report.choice) << traded.report.summary;
  plugin::Registry& registry = test::registry();
  const SceneSource source(traded.scene);
  const CaseResult chosen = run_case(source.with(traded.report.choice->overrides), registry);
  ASSERT_TRUE(chosen.done()) << chosen.reason;
  // The scale of y is the range of cos: 2. The claim bounds the true error, which cos t gives.
  EXPECT_LE(largest_error(chosen) / 2, traded.report.choice->error);
  EXPECT_LE(traded.report.choice->error, 1e-6);
}

TEST(Trade, TakesFewerThanAThirdOfTheFullGridsRuns) {
  const Traded traded(1e-6);
  const json all = json::parse(traded.report.json);
  EXPECT_LT(3 * all["search_runs"].get<int>(), all["full_grid"].get<int>());
}

TEST(Trade, WritesTheChoiceAsAFileToInclude) {
  const Traded traded(1e-4);
  const std::filesystem::path folder = traded.folder.path();
  std::ofstream(folder / "both.json") << R"({"include": ["swing.json", "choice.json"]})";
  const scene::Scene included = scene::Scene::load((folder / "both.json").string());
  ASSERT_TRUE(traded.report.choice) << traded.report.summary;
  EXPECT_EQ(included.hash(), SceneSource(traded.scene).with(traded.report.choice->overrides).hash());
}

}  // namespace
}  // namespace trammel::study
