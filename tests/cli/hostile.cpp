// Scenes made to exhaust the machine or to reach what is not theirs: each ends soon, in little memory, with exit code
// 2.
#include <functional>

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

class Hostile : public testing::Test {
 protected:
  // Of scene.json, whose problems are bounded in number and length.
  std::string error_of(const std::string& file = "scene.json") {
    const auto result = trammel({"validate", file}, {.folder = folder.path(), .time_limit = 60});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 101);
    EXPECT_LE(result.err.size(), 101 * 5000u);
    return result.err;
  }
  void write(const json& scene, const std::string& file = "scene.json") {
    cli::write_file(folder.path() / file, scene.dump());
  }
  static json empty() { return json::parse(cli::read_file(cli::bounce), nullptr, true, true); }

  cli::TemporaryFolder folder;
};

TEST_F(Hostile, TreeOfIncludesEndsAtTheMostFiles) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = std::to_string(i + 1) + ".json";
    write({{"include", {next, next}}}, std::to_string(i) + ".json");
  }
  write(empty(), "40.json");
  EXPECT_THAT(error_of("0.json"), HasSubstr("includes more than 1000 files"));
}

TEST_F(Hostile, ChainOfIncludesEndsAtItsDepth) {
  for (int i = 0; i < 300; ++i) write({{"include", std::to_string(i + 1) + ".json"}}, std::to_string(i) + ".json");
  write(empty(), "300.json");
  EXPECT_THAT(error_of("0.json"), HasSubstr("100.json:1:12: include: includes are nested deeper than 100 files"));
}

TEST_F(Hostile, IncludesAreReadToSoManyBytesTogether) {
  write({{"text", std::string(30 << 20, 'x')}}, "large.json");
  write({{"include", {"large.json", "large.json", "large.json"}}});
  EXPECT_THAT(error_of(), HasSubstr("64 MiB"));
}

class ChainOfParameters : public Hostile, public testing::WithParamInterface<int> {};

// The limit is on what they need of one another, not on how many there are.
TEST_P(ChainOfParameters, EndsAtItsDepth) {
  json scene = empty();
  for (int i = 0; i < GetParam(); ++i)
    scene["parameters"]["p" + std::to_string(i)] = "=p" + std::to_string(i + 1) + "+1";
  scene["parameters"]["p" + std::to_string(GetParam())] = 1;
  write(scene);
  if (GetParam() >= 100) {
    EXPECT_THAT(error_of(), HasSubstr("parameters use one another more than 100 deep"));
  } else {
    EXPECT_EQ(trammel({"validate", "scene.json"}, {.folder = folder.path()}).exit_code, 0);
  }
}
INSTANTIATE_TEST_SUITE_P(Of, ChainOfParameters, testing::Values(90, 100, 5000, 100000));

TEST_F(Hostile, RepetitionIsMeasuredBeforeItIsDone) {
  json scene = empty();
  scene["bodies"]["b{i}"] = {{"for", {{"i", 1000000}}}, {"junk", json(20, json(100, {1}))}};
  write(scene);
  EXPECT_THAT(error_of(), HasSubstr("bodies.b{i}.for: 1e+06 copies"));
}

TEST_F(Hostile, RepetitionOfLongTextsCountsTheirLength) {
  json scene = empty();
  scene["bodies"]["b{i}"] = {{"for", {{"i", 3000}}}, {"title", std::string(1 << 20, 'x')}};
  write(scene);
  EXPECT_THAT(error_of(), HasSubstr("copies of"));
}

TEST_F(Hostile, ProblemsAreReportedUpToAHundred) {
  json scene = empty();
  for (int i = 0; i < 3000; ++i) scene["bodies"]["b" + std::to_string(i)] = {{"type", "point_mas"}};
  write(scene);
  EXPECT_THAT(error_of(), HasSubstr("100 problems are enough"));
}

TEST_F(Hostile, TextsAreQuotedInPart) {
  json scene = empty();
  for (const char* key : {"space", "title"}) scene[key] = std::string(1 << 20, 'x');
  scene["gravity"] = "=" + std::string(1 << 20, 'g');
  write(scene);
  EXPECT_LT(error_of().size(), 5000u);
}

TEST_F(Hostile, DeepNamesDoNotMultiply) {
  std::string text = "{\"a\":";
  for (int i = 0; i < 90; ++i) text += "{\"" + std::string(400, 'n') + "\":";
  text += "[0";
  for (int i = 0; i < 60000; ++i) text += ",0";
  text += "]" + std::string(91, '}');
  cli::write_file(folder.path() / "scene.json", text);
  EXPECT_THAT(error_of(), HasSubstr("grows beyond 30000000 values"));
}

// What a scene includes or tabulates from elsewhere may be secret.
TEST_F(Hostile, NothingOfFilesOutsideIsQuoted) {
  fs::create_directory(folder.path() / "scenes");
  const std::string secret = "hunter2";
  cli::write_file(folder.path() / "key", secret + "\n" + secret + " 1\n");
  cli::write_file(folder.path() / "key.json", "{\"" + secret + "\": \"" + secret + "\"}");
  cli::write_file(folder.path() / "key.csv", "t," + secret + "\n0,1\n1," + secret + "\n");
  fs::create_symlink("../key", folder.path() / "scenes/link.json");
  const auto table = [](json entry) {
    json scene = empty();
    scene["bodies"]["base"] = {{"type", "moving_base"}, {"x", std::move(entry)}};
    return scene;
  };
  for (const json& scene :
       {json{{"include", "../key"}}, json{{"include", "../key.json"}}, json{{"include", "link.json"}},
        table({{"table", "../key"}}), table({{"table", "../key.csv"}}), table({{"table", "link.json"}}),
        table({{"table", "../key.csv"}, {"column", "hunter"}}), table({{"table", "../key.csv"}, {"time", 2}}),
        table({{"table", "../key"}, {"column", 1}}), table({{"table", "link.json"}, {"time", 1}, {"column", 1}})}) {
    write(scene, "scenes/scene.json");
    EXPECT_THAT(error_of("scenes/scene.json"), Not(HasSubstr(secret))) << scene;
  }
}

TEST_F(Hostile, PipeIsNoIncludeAndNotWaitedFor) {
  ASSERT_EQ(std::system(("mkfifo '" + (folder.path() / "pipe").string() + "'").c_str()), 0);
  write({{"include", "pipe"}});
  EXPECT_THAT(error_of(), HasSubstr("expected a regular file"));
}

// --- libraries that a scene names ---

class ScenePlugins : public Hostile {
 protected:
  void SetUp() override {
    const fs::path good = fs::path(TRAMMEL_BUILD_DIR) / "tests/plugins/good.so";
    fs::copy_file(good, folder.path() / "good.so");
    json scene = empty();
    scene["plugins"] = {"good.so"};
    scene["integrator"] = {{"type", "good"}, {"damping", 0.1}, {"step", 1e-3}};
    write(scene);
  }
  int exit_code(std::vector<std::string> more) {
    std::vector<std::string> words = {"validate", "scene.json"};
    words.insert(words.end(), more.begin(), more.end());
    return trammel(words, {.folder = folder.path()}).exit_code;
  }
};

TEST_F(ScenePlugins, NeedConsent) {
  for (const char* command : {"run", "static", "modes", "validate", "explain"}) {
    const auto result = trammel({command, "scene.json"}, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("plugins[0]: ")) << command;
    EXPECT_THAT(result.err, HasSubstr("--allow-scene-plugins")) << command;
  }
}

TEST_F(ScenePlugins, AreLoadedWithConsentOrFromATrustedFolder) {
  EXPECT_EQ(exit_code({"--allow-scene-plugins"}), 0);
  EXPECT_EQ(exit_code({"--plugin", "."}), 0);
}

}  // namespace
