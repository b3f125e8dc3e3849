// How trade varies methods that estimate no error: by their own tolerances, or by fixed steps.
#include "study/trade/methods.hpp"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/made.hpp"
#include "support/run_scene.hpp"

namespace trammel::study {
namespace {

using nlohmann::json;

const char* const swing = R"({
  "trammel": 1, "space": "planar", "gravity": [0, 0],
  "bodies": {"mass": {"type": "point_mass", "mass": 1, "position": [0, 2]}},
  "forces": {"spring": {"type": "spring_damper", "between": ["ground", "mass.point"], "stiffness": 1, "length": 1}},
  "simulate": {"until": 10}, "record": {"every": 0.1, "observe": {"y": "mass.point.y"}}
})";

struct Asked {
  test::Folder folder;
  plugin::Registry registry;
  Methods methods;
  Asked() {
    std::filesystem::create_directories(folder.path());
    const std::string scene = folder.path() / "swing.json";
    std::ofstream(scene) << swing;
    registry.search(TRAMMEL_BUILD_DIR "/lib/trammel");
    registry.search(TRAMMEL_BUILD_DIR "/tests/plugins/template_integrator.so");
    methods = methods_for(SceneSource(scene), registry);
  }
  const Method* named(const std::string& name) const {
    const auto found =
        std::find_if(methods.capable.begin(), methods.capable.end(), [&](const Method& m) { return m.name == name; });
    return found == methods.capable.end() ? nullptr : &*found;
  }
};

TEST(TradeMethods, WithoutAnErrorEstimateTakeFixedSteps) {
  const Asked asked;
  const Method* method = asked.named("my_integrator");
  ASSERT_NE(method, nullptr);
  EXPECT_EQ(method->varied, Method::Varied::step);
  // Four times, then half as long each level: the records' 0.1 s is longer than a thousandth of 10 s.
  EXPECT_EQ(json::parse(method->with_level(0))["step"], 0.04);
  EXPECT_EQ(json::parse(method->with_level(3))["step"], 0.005);
}

TEST(TradeMethods, ThatControlTheirErrorThemselvesTakeTolerances) {
  const Asked asked;
  const Method* method = asked.named("sundials_ida");
  if (!method) GTEST_SKIP() << "sundials_ida is not built";
  const json at = json::parse(method->with_tolerance(1e-7));
  EXPECT_EQ(at["rtol"], 1e-7);
  EXPECT_FALSE(at.contains("atol"));  // it goes with rtol unless the scene gives it
  EXPECT_EQ(at["step"], 0.01);
}

TEST(TradeMethods, WithAnErrorEstimateTakeTheTolerancesOfTheirSteps) {
  const Asked asked;
  const Method* method = asked.named("dop853");
  ASSERT_NE(method, nullptr);
  EXPECT_EQ(json::parse(method->with_tolerance(1e-7))["step"], json({{"tolerance", 1e-7}}));
}

}  // namespace
}  // namespace trammel::study
