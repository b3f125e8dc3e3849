#include "plugin/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trammel::plugin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// An object of its own inside a component's.
struct Panel : Component {
  double width = 1;
  Vec3 at;
  std::optional<double> tilt;
};

const Declaration panel = part<Panel>("panel", "a panel")
                              .parameter("size.width", &Panel::width, {.unit = "m", .max = 3, .required = true})
                              .parameter("at", &Panel::at)
                              .parameter("tilt", &Panel::tilt);

// One parameter of every type.
struct Everything : Component {
  enum class Colour { red, green };

  double length = 1.5;
  int count = 2;
  bool on = false;
  std::string label = "none";
  Vec3 position;
  Vec3 axis = Vec3::Unit(2, 0);
  std::optional<Vec3> hinge;
  std::optional<double> mass;
  std::vector<double> weights;
  TimeFunction torque;
  Named<double> stations;
  Named<Vec3> points;
  Named<Panel> panels;
  Colour colour = Colour::green;
  int axial = 1, transverse = 1;
  double needed = 0;

  World world;
  int prepared = 0;

  void prepare(const World& w) override {
    world = w;
    ++prepared;
    if (label == "refused") throw ParameterError("label", "this text is refused");
    if (mass && *mass == 7) throw ParameterError("hinge", "give hinge with mass 7");
    if (label == "bad") throw std::runtime_error("bad label");
  }
};

const Declaration declaration =
    body<Everything>("everything", "every type of parameter")
        .parameter("length", &Everything::length, {.unit = "m", .min = 0, .usual_max = 10, .above_min = true})
        .parameter("count", &Everything::count, {.min = 1, .max = 5})
        .parameter("on", &Everything::on)
        .parameter("label", &Everything::label)
        .parameter("position", &Everything::position, {.unit = "m", .max = 100})
        .parameter("axis", &Everything::axis)
        .parameter("mount.hinge", &Everything::hinge)
        .parameter("mass", &Everything::mass, {.unit = "kg", .min = 0})
        .parameter("weights", &Everything::weights, {.min = 0})
        .parameter("torque", &Everything::torque, {.unit = "N m", .max = 50})
        .parameter("stations", &Everything::stations, {.unit = "m", .min = 0, .max = 1})
        .parameter("points", &Everything::points)
        .parts("panels", &Everything::panels, panel)
        .choice("colour", &Everything::colour, {{"red", Everything::Colour::red}, {"green", Everything::Colour::green}})
        .parameter("modes.axial", &Everything::axial, {.min = 0, .max = 30})
        .parameter("modes.transverse", &Everything::transverse)
        .parameter("needed", &Everything::needed, {.unit = "kg", .required = true, .doc = "what nobody can guess"});

const Entry entry{declaration, "/x/everything.so"};

struct Result {
  std::unique_ptr<Component> component;
  scene::Problems problems;
  const Everything& operator*() const { return dynamic_cast<Everything&>(*component); }
  const Everything* operator->() const { return &**this; }
  // The only problem: "path: message".
  std::string problem() const {
    if (problems.errors().size() != 1) return std::to_string(problems.errors().size()) + " problems";
    return problems.errors()[0].path + ": " + problems.errors()[0].message;
  }
};

Result make_from(const std::string& json, Space space = Space::planar) {
  Result result;
  const scene::Scene scene = scene::Scene::parse(json, "scene.json");
  World world{space, Vec3::Zero(dimension(space))};
  result.component = make(entry, scene.root(), framework_keys(Kind::body), world, result.problems);
  EXPECT_EQ(result.component == nullptr, !result.problems.empty());
  return result;
}

// A scene object with what is required and `members`.
Result make_with(const std::string& members, Space space = Space::planar) {
  return make_from(R"({"type": "everything", "needed": 1, )" + members + "}", space);
}

TEST(Parameters, LeftOutKeepTheirDefaults) {
  const Result made = make_from(R"({"type": "everything", "needed": 3})");
  ASSERT_EQ(made.problems.errors().size(), 0u);
  EXPECT_EQ(made->needed, 3);
  EXPECT_EQ(made->length, 1.5);
  EXPECT_EQ(made->label, "none");
  EXPECT_EQ(made->colour, Everything::Colour::green);
}

TEST(Parameters, OfEveryTypeAreSet) {
  const Result made = make_with(R"("length": 2.5, "count": 4, "on": true, "label": "x", "position": [1, 2],
      "mount": {"hinge": [3, 4]}, "mass": 0, "weights": [5, 6, 7], "torque": 8, "stations": {"tip": 1, "middle": 0.5},
      "points": {"a": [1, 2]}, "colour": "red", "modes": {"axial": 0, "transverse": 9})");
  ASSERT_EQ(made.problems.errors().size(), 0u);
  EXPECT_EQ(made->length, 2.5);
  EXPECT_EQ(made->count, 4);
  EXPECT_TRUE(made->on);
  EXPECT_EQ(made->label, "x");
  EXPECT_EQ(made->position, (Vec(2) << 1, 2).finished());
  EXPECT_EQ(made->hinge.value(), (Vec(2) << 3, 4).finished());
  EXPECT_EQ(made->mass, 0);
  EXPECT_THAT(made->weights, ElementsAre(5, 6, 7));
  EXPECT_EQ(made->torque(0), 8);
  EXPECT_THAT(made->stations, ElementsAre(std::pair("tip", 1.0), std::pair("middle", 0.5)));
  ASSERT_EQ(made->points.size(), 1u);
  EXPECT_EQ(made->points[0].second, (Vec(2) << 1, 2).finished());
  EXPECT_EQ(made->colour, Everything::Colour::red);
  EXPECT_EQ(made->axial, 0);
  EXPECT_EQ(made->transverse, 9);
}

TEST(Parameters, OfNamedPartsAreSetInEachOfThem) {
  const Result made = make_with(R"("panels": {"left": {"size": {"width": 2}}, "right": {"size": {"width": "=1+2"},
      "at": [3, 4], "tilt": 5}})");
  ASSERT_EQ(made.problems.errors().size(), 0u);
  ASSERT_EQ(made->panels.size(), 2u);
  EXPECT_EQ(made->panels[0].first, "left");
  EXPECT_EQ(made->panels[0].second.width, 2);
  EXPECT_EQ(made->panels[0].second.at, Vec(Vec::Zero(2)));
  EXPECT_FALSE(made->panels[0].second.tilt.has_value());
  EXPECT_EQ(made->panels[1].second.width, 3);
  EXPECT_EQ(made->panels[1].second.at, (Vec(2) << 3, 4).finished());
  EXPECT_EQ(made->panels[1].second.tilt, 5);
}

TEST(Parameters, OfNamedPartsAreRefusedWhereTheyStand) {
  EXPECT_EQ(make_with(R"("panels": {"left": {"size": {"width": 4}}})").problem(),
            "panels.left.size.width: found 4, expected a number <= 3 [m]");
  EXPECT_EQ(make_with(R"("panels": {"left": {}})").problem(),
            "panels.left: \"size.width\" is missing: a number <= 3 [m]");
  EXPECT_EQ(make_with(R"("panels": {"left": 3})").problem(), "panels.left: expected an object, found a number");
  EXPECT_THAT(
      make_with(R"("panels": {"left": {"size": {"width": 1}, "tillt": 2}})").problem(),
      AllOf(StartsWith("panels.left.tillt: part \"panel\" has no parameter \"tillt\""), HasSubstr("\"tilt\"?")));
}

struct Door : Component {
  Panel leaf;
  double hinge = 0;
};

TEST(Parameters, OfAnOwnPartStandAmongTheComponents) {
  const Declaration door = body<Door>("door", "").own_part(&Door::leaf, panel).parameter("hinge", &Door::hinge);
  const Entry of_door{door, "/x/door.so"};
  const scene::Scene scene =
      scene::Scene::parse(R"({"type": "door", "size": {"width": 2.5}, "hinge": 1})", "scene.json");
  Result made;
  made.component =
      make(of_door, scene.root(), framework_keys(Kind::body), {Space::planar, Vec3::Zero(2)}, made.problems);
  ASSERT_TRUE(made.component);
  EXPECT_EQ(dynamic_cast<Door&>(*made.component).leaf.width, 2.5);
  EXPECT_EQ(dynamic_cast<Door&>(*made.component).hinge, 1);
}

TEST(Parameters, TakeExpressions) {
  const Result made = make_with(R"("length": "=2*pi", "count": "=1+1", "torque": "=3*t")");
  ASSERT_EQ(made.problems.errors().size(), 0u);
  EXPECT_EQ(made->length, 2 * 3.14159265358979323846);
  EXPECT_EQ(made->count, 2);
  EXPECT_EQ(made->torque(2), 6);
}

TEST(Parameters, ThatAreOptionalShowThatTheyAreAbsent) {
  const Result made = make_from(R"({"type": "everything", "needed": 3})");
  EXPECT_FALSE(made->mass.has_value());
  EXPECT_FALSE(made->hinge.has_value());
}

TEST(Parameters, OfVectorTypeDefaultToZeroOfTheScenesDimension) {
  EXPECT_EQ(make_from(R"({"type": "everything", "needed": 3})")->position, Vec(Vec::Zero(2)));
  EXPECT_EQ(make_with(R"("axis": [0, 0, 1])", Space::spatial)->position, Vec(Vec::Zero(3)));
}

TEST(Parameters, OfVectorTypeAreNeededWhereTheirDefaultDoesNotFit) {
  EXPECT_EQ(make_from(R"({"type": "everything", "needed": 3})", Space::spatial).problem(),
            ": \"axis\" is missing: a vector; its default [1, 0] has another dimension");
}

TEST(Parameters, AreFollowedByPrepare) {
  const Result made = make_with(R"("length": 1)");
  EXPECT_EQ(made->prepared, 1);
  EXPECT_EQ(made->world.space, Space::planar);
}

TEST(Parameters, ThatAreMisspeltGetTheNearestName) {
  const std::string problem = make_with(R"("lenght": 2)").problem();
  EXPECT_THAT(problem, StartsWith("lenght: body \"everything\" has no parameter \"lenght\""));
  EXPECT_THAT(problem, HasSubstr("\"length\"?"));
}

TEST(Parameters, ThatAreMisspeltInANestedObjectGetTheNearestName) {
  const std::string problem = make_with(R"("modes": {"axiall": 2})").problem();
  EXPECT_THAT(problem, StartsWith("modes.axiall: body \"everything\" has no parameter \"modes.axiall\""));
  EXPECT_THAT(problem, HasSubstr("\"axial\"?"));
}

TEST(Parameters, HaveNoFrameworkKeysInsideNestedObjects) {
  EXPECT_THAT(make_with(R"("modes": {"type": 2})").problem(), HasSubstr("has no parameter \"modes.type\""));
}

TEST(Parameters, OfAGroupMustStandInAnObject) {
  EXPECT_EQ(make_with(R"("modes": 3)").problem(), "modes: expected an object with axial, transverse, found a number");
}

TEST(Parameters, ThatAreRequiredAreNamedWithUnit) {
  EXPECT_EQ(make_from(R"({"type": "everything"})").problem(), ": \"needed\" is missing: a number [kg]");
}

TEST(Parameters, BelowTheirRangeAreRefused) {
  EXPECT_EQ(make_with(R"("mass": -1)").problem(), "mass: found -1, expected a number >= 0 [kg]");
}

TEST(Parameters, AboveTheirRangeAreRefused) {
  EXPECT_EQ(make_with(R"("count": 6)").problem(), "count: found 6, expected a whole number 1 to 5");
}

TEST(Parameters, AtAnOpenBoundAreRefused) {
  EXPECT_EQ(make_with(R"("length": 0)").problem(), "length: found 0, expected a number > 0 [m]");
}

TEST(Parameters, AtTheirBoundsAreTaken) {
  EXPECT_EQ(make_with(R"("count": 1)")->count, 1);
  EXPECT_EQ(make_with(R"("count": 5)")->count, 5);
}

TEST(Parameters, OutsideTheUsualGiveAWarning) {
  const Result made = make_with(R"("length": 11)");
  EXPECT_EQ(made->length, 11);
  ASSERT_EQ(made.problems.warnings().size(), 1u);
  EXPECT_EQ(made.problems.warnings()[0].message, "11 is unusual; it is usually <= 10");
}

TEST(Parameters, OfWrongTypeAreRefused) {
  for (const char* wrong :
       {R"("length": "long")", R"("count": 1.5)", R"("on": 1)", R"("label": 3)", R"("position": 1)", R"("weights": {})",
        R"("torque": [1])", R"("stations": [1])", R"("points": 3)", R"("colour": 1)", R"("length": null)"})
    EXPECT_EQ(make_with(wrong).problems.errors().size(), 1u) << wrong;
}

TEST(Parameters, WithTooManyNumbersForTheSpaceAreRefused) {
  EXPECT_EQ(make_with(R"("position": [1, 2, 3])").problem(),
            "position: found 3 numbers, expected 2: the scene is planar");
}

TEST(Parameters, HaveTheirRangeInEveryEntry) {
  EXPECT_THAT(make_with(R"("weights": [1, -2])").problem(),
              StartsWith("weights: found -2, expected a number or an array of numbers >= 0"));
  EXPECT_THAT(make_with(R"("position": [1, 101])").problem(),
              StartsWith("position: found 101, expected a vector <= 100"));
  EXPECT_THAT(make_with(R"("stations": {"tip": 2})").problem(), StartsWith("stations.tip: found 2"));
  EXPECT_THAT(make_with(R"("torque": 51)").problem(), StartsWith("torque: found 51"));
}

TEST(Parameters, ThatAreNoChoiceGetTheChoices) {
  EXPECT_EQ(make_with(R"("colour": "gren")").problem(),
            "colour: found \"gren\", expected one of \"red\", \"green\". Did you mean \"green\"?");
}

TEST(Parameters, ThatPrepareRefusesAreShownWhereTheyStand) {
  EXPECT_EQ(make_with(R"("label": "refused")").problem(), "label: this text is refused");
}

TEST(Parameters, ThatPrepareMissesAreShownAtTheObject) {
  EXPECT_EQ(make_with(R"("mass": 7)").problem(), "hinge: give hinge with mass 7");
}

TEST(Parameters, AllProblemsAreReportedAtOnce) {
  EXPECT_EQ(make_from(R"({"type": "everything", "lenght": 1, "count": 6, "mass": -1})").problems.errors().size(), 4u);
}

TEST(Parameters, AComponentThatThrowsInPrepareIsNamed) {
  try {
    make_with(R"("label": "bad")");
    FAIL() << "prepare threw";
  } catch (const PluginError& e) {
    EXPECT_STREQ(e.what(), "plugin /x/everything.so: body everything: prepare: it threw: bad label");
  }
}

}  // namespace
}  // namespace trammel::plugin
