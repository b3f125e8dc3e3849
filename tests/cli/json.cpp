// Commands with --json: one object on standard output that says what the text says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using cli::trammel;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

json object_of(std::vector<std::string> words) {
  words.push_back("--json");
  const auto result = trammel(words);
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_EQ(result.err, "");
  return json::parse(result.out);
}

TEST(JsonOutput, OfARunIsOneObjectAndNothingElse) {
  const cli::TemporaryFolder folder;
  const auto result = trammel({"run", cli::bounce, "--json"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 0);
  const json object = json::parse(result.out);  // throws on anything after the object
  EXPECT_TRUE(object.is_object());
  EXPECT_EQ(object, json::parse(cli::read_file(folder.path() / "out/bounce/result.json")));
  EXPECT_EQ(object["status"], "done");
  EXPECT_EQ(result.err, "");
}

TEST(JsonOutput, OfBadInputHoldsEveryProblemWithItsPlace) {
  const auto result =
      trammel({"validate", "several_problems.json", "--json"}, {.folder = cli::scenes.parent_path() / "cases"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "");
  const json object = json::parse(result.out);
  EXPECT_EQ(object["status"], "error");
  EXPECT_EQ(object["problems"].size(), 4u);
  for (const json& problem : object["problems"]) {
    EXPECT_EQ(problem["file"], "several_problems.json");
    EXPECT_GT(problem["line"], 1);
    EXPECT_GT(problem["column"], 1);
    EXPECT_NE(problem["path"], "");
    EXPECT_NE(problem["message"], "");
  }
}

TEST(JsonOutput, OfAMistakeOnTheCommandLineIsAnObjectToo) {
  const auto result = trammel({"run", cli::bounce, "--json", "--ot", "x"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(json::parse(result.out)["status"], "error");
  EXPECT_EQ(result.err, "");
}

TEST(JsonOutput, OfExplainHasTheSectionsOfItsText) {
  const json explained = object_of({"explain", cli::bounce});
  std::vector<std::string> titles;
  for (const json& section : explained["sections"]) titles.push_back(section["title"]);
  EXPECT_THAT(titles, Contains("Built"));
  EXPECT_THAT(titles, Contains("Left out"));
  const std::string text = trammel({"explain", cli::bounce}).out;
  for (const std::string& title : titles) EXPECT_THAT(text, HasSubstr(title + "\n"));
  EXPECT_THAT(explained["sections"][0]["lines"][0].get<std::string>(), StartsWith("planar scene: nq = 2"));
}

TEST(JsonOutput, OfDescribeHasEveryParameterWithItsRangeAndDefault) {
  const json page = object_of({"describe", "hht_alpha"})["pages"].at(0);
  EXPECT_EQ(page["kind"], "integrator");
  bool found = false;
  for (const json& parameter : page["parameters"]) {
    if (parameter["name"] != "alpha") continue;
    found = true;
    EXPECT_DOUBLE_EQ(parameter["min"].get<double>(), -1.0 / 3);
    EXPECT_EQ(parameter["max"], 0);
    EXPECT_TRUE(parameter["default"].is_number());
  }
  EXPECT_TRUE(found);
}

TEST(JsonOutput, OfDescribeHasPartsOfASceneAndPagesOnItsLanguage) {
  EXPECT_EQ(object_of({"describe", "simulate"})["pages"].at(0)["parameters"].at(0)["name"], "start");
  EXPECT_THAT(object_of({"describe", "expressions"})["pages"].at(0)["text"].get<std::string>(), HasSubstr("atan2"));
}

TEST(JsonOutput, OfAnUnknownNameIsAnErrorWithTheNearestOne) {
  const auto result = trammel({"describe", "hht_alfa", "--json"});
  EXPECT_EQ(result.exit_code, 2);
  const json answer = json::parse(result.out);
  EXPECT_EQ(answer["status"], "error");
  EXPECT_THAT(answer["problems"][0]["message"].get<std::string>(), HasSubstr("hht_alpha"));
}

TEST(JsonOutput, OfValidateHasTheWarnings) {
  EXPECT_EQ(object_of({"validate", cli::bounce})["status"], "done");
}

TEST(JsonOutput, OfTheVersionSaysWhatAResultDependsOn) {
  const json version = object_of({"--version"});
  for (const char* key : {"version", "commit", "compiler", "flags", "instruction_set"})
    EXPECT_NE(version[key].get<std::string>(), "") << key;
  bool found = false;
  for (const json& plugin : version["plugins"]) {
    EXPECT_EQ(plugin["hash"].get<std::string>().size(), 16u);
    found = found || plugin["name"] == "newmark";
  }
  EXPECT_TRUE(found);
}

// What an installation makes of the declarations of the commands.
TEST(Installation, ManualPageAndCompletionNameEveryCommandAndOption) {
  const std::string help = trammel({"help"}).out, page = trammel({"manual"}).out;
  const std::string completion = trammel({"completion"}).out;
  EXPECT_THAT(page, StartsWith(".TH TRAMMEL 1"));
  for (const char* command : {"run", "static", "modes", "validate", "explain", "list", "describe", "schema", "seal"}) {
    EXPECT_THAT(page, HasSubstr(".SS trammel " + std::string(command)));
    EXPECT_THAT(completion, HasSubstr("    " + std::string(command) + ")\n"));
  }
  EXPECT_THAT(page, HasSubstr("\\-\\-allow\\-scene\\-plugins"));
  EXPECT_THAT(completion, HasSubstr("--allow-scene-plugins"));
}

}  // namespace
