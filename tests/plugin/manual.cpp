// What is written from declarations alone: the manual page, the list and the JSON Schema.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <trammel/contact.hpp>
#include <trammel/integrator.hpp>

#include "plugin/describe.hpp"

namespace trammel::plugin {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Method : Component {
  enum class Form { stabilised, index3 };
  double alpha = -0.05;
  Form form = Form::stabilised;
  int axial = 3;
  std::optional<double> length;
  double mass = 0;
  Vec3 point = Vec3::Zero(2);
};

const Declaration method =
    integrator<Method>("method", "an example")
        .source("A. Author 2001")
        .parameter("alpha", &Method::alpha,
                   {.min = -0.5, .max = 0, .usual_min = -0.25, .usual_max = -0.0625, .doc = "numerical damping"})
        .choice("form", &Method::form, {{"stabilised", Method::Form::stabilised}, {"index3", Method::Form::index3}})
        .parameter("modes.axial", &Method::axial, {.min = 0})
        .parameter("length", &Method::length, {.unit = "m", .min = 0, .above_min = true})
        .parameter("mass", &Method::mass, {.unit = "kg", .required = true})
        .parameter("point", &Method::point);
const Declaration law = contact<Method>("law", "a contact law");

const Entry method_entry{method, "/x/method.so"}, law_entry{law, "/x/law.so"};

json scene_schema() {
  return json::parse(schema({&method_entry, &law_entry}));
}
json properties_of(const std::string& definition) {
  return scene_schema()["$defs"][definition]["properties"];
}

TEST(Describe, IsTheManualPageOfAComponent) {
  EXPECT_EQ(describe(method_entry), R"(method (integrator)
  an example
  Source: A. Author 2001
  Library: /x/method.so
  In a scene: {"type": "method", "mass": ...}

Parameters
  alpha        a number -0.5 to 0; default -0.05
               numerical damping
               usually -0.25 to -0.0625
  form         one of "stabilised", "index3"; default "stabilised"
  modes.axial  a whole number >= 0; default 3
  length       a number > 0 [m]; may be left out
  mass         a number [kg]; required
  point        a vector; default [0, 0]

Keys of every integrator
  step          fixed [s], or controlled to a tolerance: see 'trammel describe step'
  contact_step  the step while a contact is closed; "step" if left out
)");
}

TEST(Describe, SaysThatThereAreNoParameters) {
  EXPECT_THAT(describe(law_entry), HasSubstr("\nNo parameters.\n"));
}

// A latch has no parameters, and is nothing without "reaches".
TEST(Describe, SaysWhatTheFrameworkReadsBesideThem) {
  const std::string page = describe(law_entry);
  EXPECT_THAT(page, HasSubstr("In a scene: {\"type\": \"law\", \"between\": [...]}"));
  EXPECT_THAT(page, HasSubstr("\nKeys of every contact\n  between "));
  for (const char* key : {"radius ", "friction ", "reaches ", "from ", "\"on\": marker"})
    EXPECT_THAT(page, HasSubstr(key));
}

TEST(List, HasALineForEachComponentUnderItsKind) {
  EXPECT_EQ(list({&method_entry, &law_entry}),
            "integrator\n  method  an example\n\ncontact\n  law     a contact law\n");
}

TEST(Schema, HasTheSceneFormatsTopLevelKeys) {
  const json properties = scene_schema()["properties"];
  for (const char* key : {"trammel", "title", "space", "gravity", "plugins", "parameters", "include", "bodies",
                          "joints", "forces", "contacts", "integrator", "simulate", "record", "corrections"})
    EXPECT_TRUE(properties.contains(key)) << key;
  EXPECT_EQ(scene_schema()["additionalProperties"], false);
}

TEST(Schema, OffersTheNamesOfAKind) {
  EXPECT_EQ(scene_schema()["$defs"]["integrator"]["properties"]["type"]["enum"], json({"method"}));
}

TEST(Schema, HasRangeDefaultAndDocOfAParameter) {
  const json alpha = properties_of("integrator.method")["alpha"];
  EXPECT_EQ(alpha["anyOf"][0], json({{"type", "number"}, {"minimum", -0.5}, {"maximum", 0.0}}));
  EXPECT_EQ(alpha["default"], -0.05);
  EXPECT_EQ(alpha["description"], "numerical damping");
}

TEST(Schema, HasAnOpenBoundAndTheUnit) {
  const json length = properties_of("integrator.method")["length"];
  EXPECT_EQ(length["anyOf"][0], json({{"type", "number"}, {"exclusiveMinimum", 0.0}}));
  EXPECT_EQ(length["description"], "[m]");
  EXPECT_FALSE(length.contains("default"));
}

TEST(Schema, TakesAnExpressionForANumber) {
  EXPECT_EQ(properties_of("integrator.method")["alpha"]["anyOf"][1]["$ref"], "#/$defs/expression");
}

TEST(Schema, HasTheChoices) {
  EXPECT_EQ(properties_of("integrator.method")["form"]["anyOf"][0]["enum"], json({"stabilised", "index3"}));
}

TEST(Schema, PutsDottedNamesIntoNestedObjects) {
  const json modes = properties_of("integrator.method")["modes"];
  EXPECT_EQ(modes["type"], "object");
  EXPECT_EQ(modes["properties"]["axial"]["default"], 3);
}

TEST(Schema, SaysWhatIsRequiredButTakesAScenePartWithoutIt) {
  const json component = scene_schema()["$defs"]["integrator.method"];
  EXPECT_EQ(component["properties"]["mass"]["description"], "[kg] (required)");
  EXPECT_FALSE(component.contains("required"));
}

TEST(Schema, RefersOnlyToWhatItDefines) {
  const json whole = scene_schema();
  const std::function<void(const json&)> visit = [&](const json& part) {
    if (part.is_object() && part.contains("$ref")) {
      const std::string name = part["$ref"].get<std::string>().substr(std::string("#/$defs/").size());
      EXPECT_TRUE(whole["$defs"].contains(name)) << name;
    }
    if (part.is_structured())
      for (const json& inner : part) visit(inner);
  };
  visit(whole);
}

}  // namespace
}  // namespace trammel::plugin
