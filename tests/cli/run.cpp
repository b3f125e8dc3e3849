// trammel run: what it prints and writes, values set on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Run, SumsUpWhatFrictionTook) {
  const cli::TemporaryFolder folder;
  const fs::path scene = fs::path(TRAMMEL_SOURCE_DIR) / "scenes/friction/stopping.json";
  const auto result = trammel({"run", scene.string()}, {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("lost to friction of sole 0.5 J"));
}

TEST(Run, CountsTouchesOfACompliantContact) {
  const cli::TemporaryFolder folder;
  const auto result = trammel(
      {"run", cli::bounce, "--set",
       R"(contacts.floor={"type": "continuous_force", "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}], "stiffness": 1e5, "exponent": 1.5, "restitution": 1})"},
      {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 touch, 2 events in all"));  // it falls for 0.45 s, rises for as long
  EXPECT_THAT(result.out, Not(HasSubstr("impacts")));
}

TEST(Run, WritesIntoOutAndTheScenesNameByDefault) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce}, {.folder = folder.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("out/bounce"));
  for (const char* file : {"series.csv", "events.csv", "result.json", "scene.resolved.json", "checkpoint.cbor"})
    EXPECT_TRUE(fs::exists(folder.path() / "out/bounce" / file)) << file;
}

TEST(Run, HasTheColumnsOfTheContract) {
  const cli::TemporaryFolder folder;
  ASSERT_EQ(trammel({"run", cli::bounce, "--out", "r"}, {.folder = folder.path()}).exit_code, 0);
  EXPECT_EQ(cli::lines(cli::read_file(folder.path() / "r/series.csv")).front(),
            "t,height,energy_kinetic,energy_potential,energy_elastic,energy_total,energy_supplied,"
            "energy_dissipated,constraint_position,constraint_velocity,constraint_acceleration,steps");
  EXPECT_EQ(cli::lines(cli::read_file(folder.path() / "r/events.csv")).front(),
            "t,kind,component,impulse,approach,separation,energy_lost,friction,direction");
}

// Rows that are redundant for an instant: what moved, steps and events are in the reason, the remedy beside it.
TEST(Run, OfAFailureSaysWhatMovedAndARemedyThatWorks) {
  const cli::TemporaryFolder folder;
  const std::string scene = (folder.path() / "storm.json").string(), out = (folder.path() / "out").string();
  cli::write_file(scene, R"({"trammel": 1, "space": "planar", "gravity": [0, -10],
  "bodies": {"ball": {"type": "point_mass", "mass": 0.1, "position": [0, 1e-6], "velocity": [0.5, 0]}},
  "contacts": {"floor": {"type": "constraint_method", "restitution": 0.999,
                         "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]}},
  "integrator": {"type": "dop853", "step": {"tolerance": 1e-9}}, "simulate": {"until": 0.7, "event_limit": 2},
  "record": {"every": 0.01}})");
  const auto result = trammel({"run", scene, "--out", out, "--json"});
  EXPECT_EQ(result.exit_code, 1);
  const json report = json::parse(result.out);
  EXPECT_EQ(report, json::parse(cli::read_file(folder.path() / "out/result.json")));
  for (const std::string& text : {result.err, report["reason"].get<std::string>()}) {
    EXPECT_THAT(text, HasSubstr("; the steps before took "));
    EXPECT_THAT(text, HasSubstr("; the last event is impact of contacts.floor at t = "));
  }
  EXPECT_THAT(result.err, HasSubstr("Tried from t = "));
  ASSERT_TRUE(report["remedy"]["found"]);
  std::vector<std::string> again = {"run", scene, "--out", out, "--json"};
  for (const auto& [path, value] : report["remedy"]["set"].items()) {
    EXPECT_THAT(result.err, HasSubstr("--set " + path + "=" + value.get<std::string>()));
    again.insert(again.end(), {"--set", path + "=" + value.get<std::string>()});
  }
  EXPECT_GE(json::parse(trammel(again).out)["t_end"], report["remedy"]["passes"]);
}

TEST(Run, DrawsNoProgressBarIntoAFile) {
  const cli::TemporaryFolder folder;
  EXPECT_EQ(trammel({"run", cli::bounce}, {.folder = folder.path()}).err, "");
}

TEST(Run, DrawsAProgressBarOnATerminalAndRemovesIt) {
  const cli::TemporaryFolder folder;
  const std::string scene = (cli::scenes / "long_bounce.json").string();
  // A million steps: more than a minute under sanitizers on a busy machine.
  const auto result = trammel({"run", scene}, {.folder = folder.path(), .terminal = true, .time_limit = 600});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, testing::ContainsRegex(
                              "\\[#*\\.*\\] +[0-9]+ %  t = .* s, [0-9]+ steps( of [-0-9.e]+ s)?, [0-9]+ impacts"));
  EXPECT_THAT(result.err, testing::EndsWith("\r\033[K"));
}

TEST(Run, DrawsNoProgressBarWithJsonOrWhenQuiet) {
  const cli::TemporaryFolder folder;
  for (const char* option : {"--json", "--quiet"})
    EXPECT_EQ(trammel({"run", cli::bounce, option}, {.folder = folder.path(), .terminal = true}).err, "");
}

TEST(Run, IsSilentWhenQuiet) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--quiet"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST(Run, OverwritesAnEarlierResultWithNothingLeftBehind) {
  const cli::TemporaryFolder folder;
  ASSERT_EQ(trammel({"run", cli::bounce, "--out", "twice"}, {.folder = folder.path()}).exit_code, 0);
  for (const char* out : {"twice", "once"})
    ASSERT_EQ(
        trammel({"run", cli::bounce, "--out", out, "--set", "simulate.until=0.3"}, {.folder = folder.path()}).exit_code,
        0);
  // The other files contain CPU time.
  for (const char* file : {"series.csv", "events.csv", "animation.ndjson"})
    EXPECT_EQ(cli::read_file(folder.path() / "twice" / file), cli::read_file(folder.path() / "once" / file)) << file;
  const auto count = [&](const char* out) {
    return std::distance(fs::directory_iterator(folder.path() / out), fs::directory_iterator());
  };
  EXPECT_EQ(count("twice"), count("once"));
}

TEST(Set, ChangesAValueByItsPath) {
  const cli::TemporaryFolder folder;
  ASSERT_EQ(
      trammel({"run", cli::bounce, "--out", "r", "--set", "bodies.ball.position=[0, 5]", "--set=simulate.until=0"},
              {.folder = folder.path()})
          .exit_code,
      0);
  EXPECT_THAT(cli::lines(cli::read_file(folder.path() / "r/series.csv")).at(1), StartsWith("0,5,"));
}

}  // namespace
