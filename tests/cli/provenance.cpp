// What a results folder says of how it was made, and that it can be made again from it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using cli::read_file;
using cli::trammel;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

// Includes, repetition, parameters, a law of time from a table beside the included file, and a quoted header.
void write_scene_of_several_files(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "base");
  cli::write_file(folder / "base/push.csv", "\"time\",\"a, pushing\"\n0,0\n0.2,1\n0.4,-1\n0.6,0\n0.8,0\n1,0\n");
  cli::write_file(folder / "base/carts.json", R"({
    "trammel": 1, "parameters": {"n": 2, "F": "=3*n"},
    "bodies": {"base_{i}": {"for": {"i": "=n"}, "type": "moving_base",
                            "x": {"table": "push.csv", "time": "time", "column": "a, pushing", "scale": "=F"}},
               "cart_{i}": {"for": {"i": "=n"}, "type": "point_mass", "mass": "=1+{i}", "position": ["=2+{i}", 0]}},
    "forces": {"spring_{i}": {"for": {"i": "=n"}, "type": "spring_damper", "stiffness": 50, "length": "=2+{i}",
                              "between": ["base_{i}.origin", "cart_{i}.point"]}},
    "integrator": {"type": "runge_kutta_4", "step": 0.01},
    "simulate": {"until": 0.9},
    "record": {"every": 0.1, "observe": {"last": "cart_{n-1}.point.x"}}})");
  cli::write_file(folder / "scene.json", R"({"include": "base/carts.json", "title": "Carts", "parameters": {"n": 3}})");
}

TEST(ResolvedScene, RunsToTheSameBytes) {
  const cli::TemporaryFolder folder;
  write_scene_of_several_files(folder.path());
  const auto first =
      trammel({"run", "scene.json", "--out", "a", "--set", "parameters.F=7", "--quiet"}, {.folder = folder.path()});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto again = trammel({"run", "a/scene.resolved.json", "--out", "b", "--quiet"}, {.folder = folder.path()});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const std::string series = read_file(folder.path() / "a/series.csv");
  EXPECT_THAT(series, HasSubstr("t,last,energy_kinetic"));
  EXPECT_EQ(series, read_file(folder.path() / "b/series.csv"));
  EXPECT_EQ(read_file(folder.path() / "a/scene.resolved.json"), read_file(folder.path() / "b/scene.resolved.json"));
}

TEST(ResolvedScene, LiesInTheFolderOfEveryAnalysis) {
  const cli::TemporaryFolder folder;
  const std::string pendulum = (cli::scenes / "pendulum.json").string();
  for (const char* command : {"run", "static", "modes"}) {
    const auto result = trammel({command, pendulum, "--out", command, "--quiet"}, {.folder = folder.path()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string resolved = (folder.path() / command / "scene.resolved.json").string();
    EXPECT_EQ(trammel({"validate", resolved}).exit_code, 0) << command;
  }
}

TEST(Result, SaysByWhatItWasMade) {
  const cli::TemporaryFolder folder;
  const auto result =
      trammel({"run", cli::bounce, "--out", "out", "--set", "parameters.e=0.5", "--quiet"}, {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json written = json::parse(read_file(folder.path() / "out/result.json"));
  const json& made = written["made"];
  EXPECT_THAT(
      made["command"].get<std::vector<std::string>>(),
      ElementsAre(HasSubstr("trammel"), "run", cli::bounce, "--out", "out", "--set", "parameters.e=0.5", "--quiet"));
  EXPECT_EQ(made["set"], json::parse(R"(["parameters.e=0.5"])"));
  EXPECT_THAT(made["date"].get<std::string>(), MatchesRegex("20..-..-..T..:..:..Z"));
  for (const char* key : {"version", "commit", "build_type", "instruction_set", "compiler", "flags"})
    EXPECT_NE(made["program"][key].get<std::string>(), "") << key;
  EXPECT_NE(made["host"]["instruction_set"].get<std::string>(), "");
  ASSERT_EQ(written["plugins"].size(), 3u);
  for (const json& plugin : written["plugins"]) {
    EXPECT_THAT(plugin["hash"].get<std::string>(), MatchesRegex("[0-9a-f]{16}"));
    EXPECT_NE(plugin["hash"].get<std::string>(), std::string(16, '0'));
    EXPECT_THAT(plugin["compiler"].get<std::string>(), MatchesRegex("(gcc|clang) [0-9]+"));
    EXPECT_THAT(plugin["sdk"].get<std::string>(), MatchesRegex("[0-9]+\\.[0-9]+"));
  }
}

}  // namespace
