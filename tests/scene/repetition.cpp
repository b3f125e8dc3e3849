// Units that a scene repeats.
#include <gtest/gtest.h>

#include "scene/value.hpp"

namespace trammel::scene {
namespace {

std::string error_of(const std::string& text) {
  try {
    Scene::parse(text, "s");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> names(const Scene& scene, const char* group) {
  std::vector<std::string> all;
  for (const auto& [name, value] : scene.root().find(group)->members()) all.push_back(name);
  return all;
}

std::string text_at(const Scene& scene, const char* group, const char* name, const char* key) {
  return scene.root().find(group)->find(name)->find(key)->text();
}

TEST(Repetition, CountsFromZeroOrBetweenTwoNumbers) {
  const Scene scene = Scene::parse(
      R"({"parameters": {"n": 3}, "bodies": {"a_{i}": {"for": {"i": "=n"}}, "b_{i}": {"for": {"i": [-1, "=n-2"]}}, "c": {}}})",
      "s");
  EXPECT_EQ(names(scene, "bodies"), (std::vector<std::string>{"a_0", "a_1", "a_2", "b_-1", "b_0", "b_1", "c"}));
}
TEST(Repetition, CountsAllCombinationsTheLastFastest) {
  const Scene scene = Scene::parse(R"({"bodies": {"a_{i}_{k}": {"for": {"i": 2, "k": 2}}}})", "s");
  EXPECT_EQ(names(scene, "bodies"), (std::vector<std::string>{"a_0_0", "a_0_1", "a_1_0", "a_1_1"}));
}
TEST(Repetition, FillsInWholeNumbersEverywhere) {
  const Scene scene = Scene::parse(
      R"({"parameters": {"n": 2}, "joints": {"j_{i}": {"for": {"i": [-1, 0]}, "x": "={i}*2", "of": "b_{i+1}.c_{(i+4)*n}"}},
          "record": {"observe": {"tip": "b_{n-1}.x"}}})",
      "s");
  EXPECT_EQ(text_at(scene, "joints", "j_-1", "x"), "=(-1)*2");
  EXPECT_EQ(text_at(scene, "joints", "j_-1", "of"), "b_0.c_6");
  EXPECT_EQ(scene.root().at_path("record.observe.tip")->text(), "b_1.x");
  Problems problems;
  EXPECT_EQ(scene.root().at_path("joints.j_-1.x")->read_number(problems), -2);
}
TEST(Repetition, CountsNothing) {
  EXPECT_TRUE(names(Scene::parse(R"({"bodies": {"a_{i}": {"for": {"i": 0}}}})", "s"), "bodies").empty());
  EXPECT_TRUE(names(Scene::parse(R"({"bodies": {"a_{i}": {"for": {"i": [1, 0]}}}})", "s"), "bodies").empty());
}
TEST(Repetition, RefusesFewerCopiesThanNone) {
  EXPECT_NE(error_of(R"({"bodies": {"a_{i}": {"for": {"i": -1}}}})")
                .find("bodies.a_{i}.for.i: \"i\" counts -1 copies, expected 0 or more"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"bodies": {"a_{i}": {"for": {"i": [1, -1]}}}})")
                .find("\"i\" counts from 1 to -1, expected a last number of at least 0 (no copy then)"),
            std::string::npos);
}
TEST(Repetition, ToldOneBoundIsNoWholeNumberSaysNoMoreOfIt) {
  const std::string error = error_of(R"({"bodies": {"a_{i}": {"for": {"i": [1, -1.5]}}}})");
  EXPECT_NE(error.find("bodies.a_{i}.for.i[1]: found -1.5, expected a whole number"), std::string::npos) << error;
  EXPECT_EQ(error.find("counts"), std::string::npos) << error;
}
TEST(Repetition, MeansWhatTheWrittenCopiesMean) {
  const Scene written = Scene::parse(R"({"bodies": {"a_0": {"x": 1}, "a_1": {"x": 1}}})", "s");
  EXPECT_EQ(Scene::parse(R"({"bodies": {"a_{i}": {"for": {"i": 2}, "x": 1}}})", "s").hash(), written.hash());
}
TEST(Repetition, RefusesWhatItCannotMean) {
  const auto refused = [](const char* unit, const char* why) {
    const std::string error = error_of(std::string(R"({"parameters": {"n": 2}, "bodies": {)") + unit + "}}");
    EXPECT_NE(error.find(why), std::string::npos) << error;
  };
  refused(R"("a": {"for": {"i": 2}})", "bodies.a: there are several of the name \"a\"");
  refused(R"("a_{i}": {"for": {"i": 1.5}})", "bodies.a_{i}.for.i: found 1.5, expected a whole number");
  refused(R"("a_{i}": {"for": {"i": 2000000}})", "found 2e+06 copies, expected at most 1e+06");
  refused(R"("a_{i}": {"for": {"i": [-2000000000, 2000000000]}})", "found 4e+09 copies, expected at most 1e+06");
  refused(R"("a_{i}": {"for": {"n": 2}})", "\"n\" is a parameter already");
  refused(R"("a_{i}": {"for": 2})", "found a number, expected {\"i\": 8} or {\"i\": [1, 8]}");
  refused(R"("a_{i}": {"for": {"i": 2}, "x": "b_{j}"})", "in {j}, column 1: nothing here counts by \"j\"; known: i, n");
  refused(R"("a_{i}": {"for": {"i": 2}, "x": "b_{i/2}"})", "found {i/2} = 0.5, expected a whole number");
  refused(R"("a_{i}": {"for": {"i": 2}, "x": "b_{i"})", "\"b_{i\" has a { without its }");
}

}  // namespace
}  // namespace trammel::scene
