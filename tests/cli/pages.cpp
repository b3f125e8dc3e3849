// The commands that describe components and scenes: list, describe, schema.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;

TEST(List, NamesTheComponentsOfEveryKind) {
  const auto result = trammel({"list"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* name : {"hht_alpha", "runge_kutta_4", "assumed_mode_beam", "rigid_body", "revolute", "spring_damper",
                           "constraint_method", "continuous_force"})
    EXPECT_THAT(result.out, HasSubstr(name));
  EXPECT_EQ(result.err, "");
}

TEST(List, GivesJsonWithTheLibraryOfEachComponent) {
  const json all = json::parse(trammel({"list", "--json"}).out);
  EXPECT_EQ(all["status"], "done");
  bool found = false;
  for (const json& component : all["components"]) {
    found = found || component["name"] == "hht_alpha";
    EXPECT_TRUE(fs::exists(component["file"].get<std::string>())) << component;
  }
  EXPECT_TRUE(found);
}

TEST(Describe, ShowsParametersWithRangeAndDefault) {
  const auto result = trammel({"describe", "constraint_method"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("restitution"));
  EXPECT_THAT(result.out, HasSubstr("0 to 1"));
  EXPECT_THAT(result.out, HasSubstr("capture_speed"));
  EXPECT_THAT(result.out, HasSubstr("m/s"));
}

TEST(Describe, KnowsThePartsOfASceneThatTheProgramReads) {
  for (const auto& [part, keys] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"step", {"tolerance", "relative", "absolute", "initial", "min", "max"}},
           {"simulate",
            {"start", "until", "contact_hold", "chatter_steps", "event_limit", "default 1000000", "Chatter:"}},
           {"integrator", {"step", "contact_step", "'trammel describe step'"}},
           {"initial", {"check", "project", "equilibrium"}},
           {"record", {"every", "fields", "observe"}},
           {"static", {"steps", "tolerance", "iterations", "arc_length"}}}) {
    const auto result = trammel({"describe", part});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const std::string& key : keys) EXPECT_THAT(result.out, HasSubstr(key)) << part;
  }
}

TEST(Describe, SaysThatErrorControlledAdamsIsMostlyItsStart) {
  EXPECT_THAT(trammel({"describe", "adams_baumgarte"}).out, HasSubstr("runge_kutta_4"));
}

TEST(Schema, DescribesWhatTheProgramReads) {
  const json schema = json::parse(trammel({"schema"}).out);
  const json simulate = schema["properties"]["simulate"]["properties"];
  for (const char* key : {"until", "contact_hold", "chatter_steps", "event_limit"})
    EXPECT_NE(simulate[key].value("description", ""), "") << key;
  EXPECT_EQ(simulate["chatter_steps"]["default"], 3);
}

TEST(Schema, RequiresWhatASceneOfItsOwnMustHave) {
  const json schema = json::parse(trammel({"schema"}).out);
  EXPECT_EQ(schema["if"]["required"], json({"include"}));  // what is included may hold it
  EXPECT_EQ(schema["else"]["anyOf"][0]["required"], json({"simulate"}));
  EXPECT_EQ(schema["else"]["properties"]["simulate"]["required"], json({"until"}));
  bool beam = false;
  for (const json& one : schema["else"]["properties"]["bodies"]["additionalProperties"]["allOf"])
    if (one["if"]["properties"]["type"]["const"] == "assumed_mode_beam") {
      beam = true;
      EXPECT_THAT(one["then"]["required"].dump(), HasSubstr("length"));
    }
  EXPECT_TRUE(beam);
}

TEST(Schema, IsAJsonSchemaThatKnowsTheComponents) {
  const auto result = trammel({"schema"});
  EXPECT_EQ(result.exit_code, 0);
  const json schema = json::parse(result.out);
  EXPECT_THAT(schema["$schema"].get<std::string>(), HasSubstr("json-schema.org"));
  EXPECT_TRUE(schema["$defs"].contains("body.assumed_mode_beam"));
}

}  // namespace
