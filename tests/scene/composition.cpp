// Parameters, includes and overrides.
#include <gtest/gtest.h>

#include "scene/suggestion.hpp"
#include "scene/value.hpp"

#include "folder.hpp"

namespace trammel::scene {
namespace {

double number(const Scene& scene, const char* path) {
  Problems problems;
  const Value* value = scene.root().at_path(path);
  const auto x = value ? value->read_number(problems) : std::nullopt;
  EXPECT_TRUE(x) << path;
  return x.value_or(0);
}

template <class Load>
std::string error_of(Load load) {
  try {
    load();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Parameters, UseOneAnotherInAnyOrder) {
  const Scene scene =
      Scene::parse(R"({"parameters": {"a": "=2*b", "b": 3, "name": "beam"}, "x": "=a + 1", "t": "=name"})", "s");
  EXPECT_EQ(number(scene, "x"), 7);
  Problems problems;
  EXPECT_EQ(scene.root().find("t")->read_text(problems), "beam");
}

TEST(Parameters, RefuseToGoRoundInACircle) {
  const auto error = error_of([] { Scene::parse(R"({"parameters": {"a": "=b", "b": "=a + 1"}})", "s"); });
  EXPECT_NE(error.find("parameters go round in a circle: a -> b -> a"), std::string::npos) << error;
}

TEST(Parameters, SuggestTheNearestName) {
  const Scene scene = Scene::parse(R"({"parameters": {"stiffness": 1}, "k": "=2*stifness"})", "s.json");
  Problems problems;
  EXPECT_FALSE(scene.root().find("k")->read_number(problems));
  EXPECT_NE(
      problems.errors()[0].text().find("s.json:1:39: k: in the expression \"=2*stifness\", column 4: no parameter"),
      std::string::npos)
      << problems.errors()[0].text();
  EXPECT_NE(problems.errors()[0].message.find("Did you mean \"stiffness\"?"), std::string::npos);
}

TEST(Override, ActsBeforeParametersAreEvaluated) {
  const Scene scene = Scene::parse(R"({"parameters": {"N": 3}, "m": "=2*N", "o": {"p": [1, 2]}})", "s",
                                   {{"parameters.N", "5"}, {"o.p[1]", "7"}, {"o.q", "true"}});
  EXPECT_EQ(number(scene, "m"), 10);
  EXPECT_EQ(scene.root().at_path("o.p")->items()[1].position().file, "--set o.p[1]=7");
  EXPECT_TRUE(scene.root().at_path("o.q")->boolean());
}

TEST(Override, TakesBareTextAndJson) {
  const Scene scene = Scene::parse(R"({"a": 1, "b": 2})", "s", {{"a", "10x10"}, {"b", "\"=1 + 1\""}});
  EXPECT_EQ(scene.root().find("a")->text(), "10x10");
  EXPECT_EQ(number(scene, "b"), 2);
}

TEST(Override, MakesTheObjectsOnItsWayWithinAComponent) {
  const Scene scene = Scene::parse(R"({"bodies": {"beam": {"length": 1}}, "integrator": {"step": 1e-3}})", "s",
                                   {{"bodies.beam.initial.axial", "[0, 0]"},
                                    {"integrator.step.tolerance", "1e-9"},
                                    {"integrator.step.max", "1e-2"}});
  EXPECT_EQ(scene.root().at_path("bodies.beam.initial.axial")->items().size(), 2u);
  EXPECT_EQ(number(scene, "integrator.step.tolerance"), 1e-9);
  EXPECT_EQ(number(scene, "integrator.step.max"), 1e-2);
}

TEST(Override, RemovesAMemberByNull) {
  const Scene scene = Scene::parse(R"({"mount": {"hinge": 1, "free": 2}})", "s", {{"mount.hinge", "null"}});
  EXPECT_EQ(scene.root().at_path("mount.hinge"), nullptr);
  EXPECT_EQ(number(scene, "mount.free"), 2);
  const auto error = error_of([] { Scene::parse(R"({"mount": {"hinge": 1}})", "s", {{"mount.hing", "null"}}); });
  EXPECT_EQ(error, "--set mount.hing=null: mount.hing: null removes a member, and there is none");
}

TEST(Override, RefusesNumbersThatAreNotFinite) {
  for (const char* value : {"nan", "-inf", "1e999", "infinity"}) {
    const auto error = error_of([&] { Scene::parse(R"({"parameters": {"N": 5}})", "s", {{"parameters.N", value}}); });
    EXPECT_EQ(error.find("--set parameters.N=" + std::string(value) + ": parameters.N: found " + value), 0u) << error;
  }
}

TEST(Override, WarnsOfParametersThatNothingUses) {
  const std::string scene = R"({"parameters": {"e": 0.3, "a": 1, "twice": "=2*a", "b": 2, "four": "=2*b", "who": "me"},
                                "x": "=1e5 + four", "name": "=who"})";
  const auto warned = [&](const std::string& name) {
    const auto warnings = Scene::parse(scene, "s", {{"parameters." + name, "1"}}).warnings();
    return !warnings.empty();
  };
  EXPECT_TRUE(Scene::parse(scene, "s").warnings().empty());
  EXPECT_TRUE(warned("e"));  // 1e5 is a number
  EXPECT_TRUE(warned("a"));  // used by "twice", which nothing uses
  EXPECT_FALSE(warned("b"));
  EXPECT_FALSE(warned("who"));
}

TEST(Override, NamesTheNearestMemberOnItsWay) {
  const auto error = error_of([] { Scene::parse(R"({"contacts": {"tip": {}}})", "s", {{"contacts.tpi.e", "1"}}); });
  EXPECT_EQ(error, "--set contacts.tpi.e=1: contacts: has no member \"tpi\"; known: tip. Did you mean \"tip\"?");
}

TEST(Include, LetsTheIncludingFileWinMemberByMember) {
  const Folder folder("trammel_composition");
  folder.file("base.json", R"({"a": {"x": 1, "y": 2}, "b": {"type": "one", "p": 1}, "c": {"type": "one", "p": 1}})");
  const Scene scene = Scene::load(folder.file(
      "top.json",
      R"({"include": "base.json", "a": {"y": 3}, "b": {"type": "two", "r": 1}, "c": {"type": "one", "r": 2}})"));
  EXPECT_EQ(number(scene, "a.x"), 1);
  EXPECT_EQ(number(scene, "a.y"), 3);
  EXPECT_EQ(scene.root().at_path("b.p"), nullptr);  // another type: parameters of the old one mean nothing
  EXPECT_EQ(number(scene, "c.p"), 1);
}

TEST(Include, LetsNullRemoveWhatIsIncluded) {
  const Folder folder("trammel_composition");
  folder.file("base.json", R"({"beam": {"mount": {"hinge": [0, 0]}, "length": 1}, "contacts": {"tip": {}}})");
  const Scene scene = Scene::load(folder.file(
      "top.json", R"({"include": "base.json", "beam": {"mount": {"hinge": null, "free": 1}}, "contacts": null})"));
  EXPECT_EQ(scene.root().at_path("beam.mount.hinge"), nullptr);
  EXPECT_EQ(number(scene, "beam.mount.free"), 1);
  EXPECT_EQ(number(scene, "beam.length"), 1);
  EXPECT_EQ(scene.root().find("contacts"), nullptr);
}

TEST(Include, IsRelativeToTheIncludingFile) {
  const Folder folder("trammel_composition");
  folder.file("base.json", R"({"a": 1})");
  folder.file("sub/middle.json", R"({"include": ["../base.json"], "b": 2})");
  const Scene scene = Scene::load(folder.file("top.json", R"({"include": "sub/middle.json"})"));
  EXPECT_EQ(number(scene, "a") + number(scene, "b"), 3);
}

TEST(Include, ReportsACircleWithItsChain) {
  const Folder folder("trammel_composition");
  folder.file("b.json", R"({"include": "a.json"})");
  const std::string a = folder.file("a.json", R"({"include": "b.json"})");
  const auto error = error_of([&] { Scene::load(a); });
  EXPECT_NE(error.find("b.json:1:13: include: includes go round in a circle: "), std::string::npos) << error;
}

TEST(Include, NamesAFileThatIsMissing) {
  const Folder folder("trammel_composition");
  const std::string a = folder.file("a.json", R"({"include": "none.json"})");
  const auto error = error_of([&] { Scene::load(a); });
  EXPECT_NE(error.find("a.json:1:13: include: cannot include \"none.json\""), std::string::npos) << error;
}

TEST(Suggestion, FindsTheNearestName) {
  EXPECT_EQ(nearest("restituton", {"restitution", "friction"}), "restitution");
  EXPECT_EQ(nearest("HHT_alpha", {"hht_alpha", "newmark"}), "hht_alpha");
  EXPECT_EQ(nearest("xyz", {"hht_alpha", "newmark"}), "");
  EXPECT_EQ(nearest("foo", {"cos", "sin"}), "");  // one letter of three in common
  EXPECT_EQ(nearest("sni", {"cos", "sin"}), "sin");
}

TEST(Suggestion, CompletesABeginning) {
  EXPECT_EQ(nearest("hht", {"newmark", "hht_alpha_modified", "hht_alpha"}), "hht_alpha");
  EXPECT_EQ(nearest("HHT", {"newmark", "hht_alpha"}), "hht_alpha");
}

TEST(Expression, ThatIsVeryLongIsQuotedInPart) {
  const std::string deep = "=" + std::string(100000, '(') + "1" + std::string(100000, ')');
  const auto error = error_of([&] {
    Problems problems;
    Scene::parse(R"({"x": 1})", "s", {{"x", deep}}).root().find("x")->read_number(problems);
    problems.throw_if_any();
  });
  EXPECT_NE(error.find("too deeply nested"), std::string::npos) << error.substr(0, 500);
  EXPECT_LT(error.size(), 500u);
}

}  // namespace
}  // namespace trammel::scene
