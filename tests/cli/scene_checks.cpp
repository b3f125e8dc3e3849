// The commands that examine a scene without running it: validate, explain.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using testing::HasSubstr;
using testing::Not;

TEST(Validate, AcceptsEveryCommittedScene) {
  int scenes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(TRAMMEL_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".json" && entry.path().parent_path().filename() != "studies") {
      ++scenes;
      const auto result = trammel({"validate", entry.path().string()});
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
  EXPECT_GT(scenes, 0);
}

TEST(Validate, WarnsOfAParameterThatIsSetInVain) {
  const auto result =
      trammel({"validate", cli::bounce, "--set", "contacts.floor.restitution=0.5", "--set", "parameters.e=0.3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "warning: --set parameters.e=0.3: parameters.e: has no effect: nothing in this scene uses it\n");
}

TEST(Explain, NamesTheIntegratorAndTheBodies) {
  const auto result = trammel({"explain", cli::pendulum});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* text : {"hht_alpha", "rigid_body", "revolute"}) EXPECT_THAT(result.out, HasSubstr(text));
}

TEST(Explain, NamesTheIntegratorThatASceneWithoutOneGets) {
  const auto result = trammel({"explain", TRAMMEL_SOURCE_DIR "/tests/cli/scenes/no_integrator.json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("integrator dop853: step error-controlled, relative 1e-09"));
}

TEST(Explain, ShowsTheWarningsOfASceneToo) {
  EXPECT_THAT(trammel({"explain", cli::bounce}).out, Not(HasSubstr("Warnings")));
  const auto vain =
      trammel({"explain", cli::bounce, "--set", "contacts.floor.restitution=0.5", "--set", "parameters.e=0.3"});
  EXPECT_THAT(vain.out, HasSubstr("Warnings\n  --set parameters.e=0.3"));
}

}  // namespace
