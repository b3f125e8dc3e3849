// A run that is cut and resumed gives the bytes of one that was not.
//
// The program's side of it, signals and files, is in tests/cli/interruption.cpp; here runs are cut after exact numbers
// of steps.
#include <atomic>
#include <bit>
#include <cmath>

#include "support/run_in_pieces.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

// Of this name, however deep; null: there is none.
nlohmann::json* find(nlohmann::json& object, const char* name) {
  for (auto& [key, value] : object.items()) {
    if (key == name) return &value;
    if (!value.is_object()) continue;
    if (nlohmann::json* const below = find(value, name)) return below;
  }
  return nullptr;
}

class Resumed : public testing::TestWithParam<Method> {
 protected:
  scene::Scene scene(const std::string& text) const {
    return scene::Scene::parse(text, "test.json", {{"integrator", GetParam().json}});
  }
};

TEST_P(Resumed, RunOfAStruckBarEndsWithTheSameBytes) {
  const scene::Scene bar = scene(struck_bar);
  const Logs whole = run_in_pieces(bar, 1LL << 60);
  ASSERT_NE(whole.events.find("contact_close"), std::string::npos);
  ASSERT_NE(whole.events.find("contact_open"), std::string::npos);
  const Logs pieces = run_in_pieces(bar, std::max(1LL, whole.steps / 23));
  EXPECT_GT(pieces.cuts_in_contact, 0);
  EXPECT_TRUE(pieces.series == whole.series);
  EXPECT_TRUE(pieces.events == whole.events);
  EXPECT_EQ(nlohmann::json::diff(whole.data, pieces.data).dump(), "[]");  // and so would all that follows
}

TEST_P(Resumed, RunCutAfterEveryStepEndsWithTheSameBytes) {
  // In the middle of what a multistep method remembers, right after impacts, between the rows of one step.
  const scene::Scene bounces = scene::Scene::parse(ball, "test.json",
                                                   {{"integrator", GetParam().json},
                                                    {"simulate.until", "0.6"},
                                                    {"bodies.ball.position", "[0, 0.05]"},
                                                    {"record.every", "0.003"}});
  const Logs whole = run_in_pieces(bounces, 1LL << 60), pieces = run_in_pieces(bounces, 1);
  EXPECT_TRUE(pieces.series == whole.series);
  EXPECT_TRUE(pieces.events == whole.events);
  EXPECT_EQ(nlohmann::json::diff(whole.data, pieces.data).dump(), "[]");
}

std::vector<Method> all_methods() {
  std::vector<Method> methods = fixed_methods("1.7e-3");
  for (const Method& method : controlled_methods("1e-6")) methods.push_back(method);
  methods.push_back({"adams_with_contact_step",
                     R"({"type": "adams_baumgarte", "delta": 50, "epsilon": 50, "step": 1e-3, "contact_step": 3e-4})"});
  return methods;
}
INSTANTIATE_TEST_SUITE_P(With, Resumed, testing::ValuesIn(all_methods()), method_name);

// A block thrown up an incline comes down again: its slip has turned by more than a right angle when a ball bounces
// elsewhere, which changes none of the block's modes.
TEST(ResumedRun, AfterASlipHasTurnedEndsWithTheSameBytes) {
  const scene::Scene scene = scene::Scene::parse(R"({
    "trammel": 1, "space": "spatial", "gravity": [5, 0, -8],
    "bodies": {"block": {"type": "point_mass", "mass": 1, "velocity": [-1, 0.3, 0], "position": [0, 0, 0]},
               "ball": {"type": "point_mass", "mass": 1, "position": [0, 5, 1]}},
    "contacts": {
      "foot": {"type": "constraint_method", "between": ["block.point", {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
               "friction": {"type": "coulomb", "static": 0.1, "kinetic": 0.1}},
      "floor": {"type": "constraint_method", "restitution": 0.5,
                "between": ["ball.point", {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]}},
    "integrator": {"type": "dormand_prince", "step": {"tolerance": 1e-8}}, "simulate": {"until": 0.6},
    "record": {"every": 0.05, "observe": {"vx": "block.point.vx"}}})",
                                                 "test.json");
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 1);
  EXPECT_NE(whole.events.find("floor"), std::string::npos);
  EXPECT_TRUE(pieces.series == whole.series);
  EXPECT_TRUE(pieces.events == whole.events);
  EXPECT_EQ(nlohmann::json::diff(whole.data, pieces.data).dump(), "[]");
}

TEST(ResumedRun, InsideACompliantContactEndsWithTheSameBytes) {
  const scene::Scene scene = scene::Scene::parse(
      ball, "test.json", {{"contacts.floor", R"({"type": "continuous_force", "stiffness": 1e4, "restitution": 0.8,
        "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"}});
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 7);
  EXPECT_GT(pieces.cuts_in_contact, 0);
  EXPECT_TRUE(pieces.series == whole.series);
  EXPECT_TRUE(pieces.events == whole.events);
}

// A block that rocks on two feet, each a body of its own: one contact opens as the other closes, as many rows in
// another pattern. The chain on it makes the bodies many, whose rows are eliminated in an order found from their
// pattern.
nlohmann::json rocking_block_with_a_chain(nlohmann::json integrator) {
  using nlohmann::json;
  constexpr double b = 0.1, h = 0.5, link = 0.03, tilt = -0.0987, foot = 0.05;
  const double radius = std::hypot(b, h), lean = std::atan(b / h) + tilt;
  const double at[] = {-radius * std::sin(lean), radius * std::cos(lean)};
  const auto place = [&](double x, double y) {
    return json{at[0] + std::cos(tilt) * x - std::sin(tilt) * y, at[1] + std::sin(tilt) * x + std::cos(tilt) * y};
  };
  const auto body = [](json position, double angle, double mass, double inertia, json markers) {
    return json{{"type", "rigid_body"}, {"mass", mass},
                {"inertia", inertia},   {"position", std::move(position)},
                {"angle", angle},       {"markers", std::move(markers)}};
  };
  const auto joint = [](const char* type, const std::string& A, const std::string& B) {
    return json{{"type", type}, {"between", {A, B}}};
  };
  json scene = {{"trammel", 1}, {"space", "planar"}, {"gravity", {0, -9.81}}};
  json &bodies = scene["bodies"], &joints = scene["joints"], &contacts = scene["contacts"];
  const json markers = {{"left", {-b, -h}}, {"right", {b, -h}}, {"top", {0, 0.4}}};
  bodies["block"] = body(place(0, 0), tilt, 1, radius * radius / 3, markers);
  for (const auto& [side, x] :
       {std::pair<std::string, double>("left", -b), std::pair<std::string, double>("right", b)}) {
    bodies[side] = body(place(x, -h), tilt, foot, foot * b * b, {{"tip", {0, 0}}});
    joints[side] = joint("fixed", "block." + side, side + ".com");
    contacts[side] = {{"type", "constraint_method"},
                      {"restitution", 0},
                      {"friction", {{"type", "coulomb"}, {"static", 10}, {"kinetic", 10}}},
                      {"between", {side + ".tip", {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}}}}};
  }
  std::string from = "block.top";
  for (int i = 0; i < 20; ++i) {
    const std::string name = "link" + std::to_string(i);
    json top = place(0, 0.4);
    top[1] = top[1].get<double>() - link * (i + 0.5);
    bodies[name] = body(top, 0, 0.005, 1e-6, {{"a", {0, link / 2}}, {"b", {0, -link / 2}}});
    joints[name] = joint("revolute", from, name + ".a");
    from = name + ".b";
  }
  scene["integrator"] = std::move(integrator);
  scene["simulate"] = {{"until", 0.9}};
  scene["record"] = {{"every", 0.01}, {"observe", {{"theta", "block.angle"}}}};
  return scene;
}

TEST(ResumedRun, WhoseRowsTakeTurnsEndsWithTheSameBytes) {
  using nlohmann::json;
  for (const json& integrator : {json{{"type", "dop853"}, {"rows", "null_space"}, {"step", 2e-4}},
                                 json{{"type", "hht_alpha"}, {"step", 5e-4}}}) {
    SCOPED_TRACE(integrator.dump());
    const scene::Scene scene = scene::Scene::parse(rocking_block_with_a_chain(integrator).dump(), "test.json");
    const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, whole.steps / 7);
    ASSERT_NE(whole.events.find("contact_open"), std::string::npos);
    EXPECT_TRUE(pieces.series == whole.series);
    EXPECT_TRUE(pieces.events == whole.events);
  }
}

// A chain of many bodies that strikes a table, itself a body on a spring, and leaves it: the contacts' stiffness
// couples two bodies in the iteration matrix while they touch, as many rows in another pattern.
TEST(ResumedRun, OfAChainThatHasLeftASoftTableEndsWithTheSameBytes) {
  const scene::Scene scene = scene::Scene::parse(R"json({
    "trammel": 1, "space": "planar", "gravity": [0, -9.81], "parameters": {"n": 12},
    "bodies": {
      "table": {"type": "rigid_body", "mass": 1, "inertia": 0.1, "position": [0.6, -0.02]},
      "link{i}": {"for": {"i": "=n"}, "type": "rigid_body", "mass": "=0.1+0.01*{i}", "inertia": 1e-4,
        "markers": {"a": [-0.05, 0], "b": [0.05, 0]}, "position": ["={i}*0.1+0.05", 0]}},
    "joints": {
      "rail": {"type": "prismatic", "between": [{"point": [0.6, 0]}, "table.com"], "axis": [0, 1]},
      "hinge{i}": {"for": {"i": [1, "=n-1"]}, "type": "revolute", "between": ["link{i-1}.b", "link{i}.a"]}},
    "forces": {"spring": {"type": "spring_damper", "between": [{"point": [0.6, 1]}, "table.com"], "stiffness": 200,
      "damping": 1, "length": 1}},
    "contacts": {"foot{i}": {"for": {"i": "=n"}, "type": "continuous_force", "stiffness": "=1e4*(1+{i})",
      "restitution": 0.8, "between": ["link{i}.com", {"plane": {"point": [0, 0], "normal": [0, 1], "on": "table.com"}}]}},
    "integrator": {"type": "hht_alpha", "step": 5e-4}, "simulate": {"until": 0.25},
    "record": {"every": 0.01, "observe": {"x": "link3.com.x", "y": "link7.com.y"}}})json",
                                                 "test.json");
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, whole.steps / 7);
  EXPECT_NE(whole.events.find("foot11"), std::string::npos) << whole.events;
  EXPECT_TRUE(pieces.series == whole.series);
}

TEST(ResumedRun, MayEndLaterThanItWasToEndAtFirst) {
  // At a row whose time is exact in binary, so that both runs stop there.
  const Folder once, twice;
  const auto go = [](const Folder& folder, const char* until, bool resume) {
    simulate::RunOptions options;
    options.out = folder.path();
    options.resume = resume;
    return simulate::run(scene::Scene::parse(struck_bar, "test.json", {{"simulate.until", until}}), registry(), options)
        .status;
  };
  ASSERT_EQ(go(once, "1.5", false), simulate::Status::done);
  ASSERT_EQ(go(twice, "0.75", false), simulate::Status::done);
  ASSERT_EQ(go(twice, "1.5", true), simulate::Status::done);
  for (const char* log : {"series.csv", "events.csv"})
    EXPECT_TRUE(read_text(once.path() / log) == read_text(twice.path() / log)) << log;
}

// Interrupted as soon as it begins: what happened at its start, a bar that lies on the plane, is written all the same.
TEST(ResumedRun, KeepsTheEventsOfItsStart) {
  const Folder once, twice;
  const scene::Scene scene =
      scene::Scene::parse(struck_bar, "test.json",
                          {{"simulate.until", "0.5"}, {"bodies.bar.position", "[0.5, 0]"}, {"bodies.bar.angle", "0"}});
  simulate::Interrupt at_once;
  at_once.request();
  const auto go = [&](const Folder& folder, simulate::Interrupt* interrupt, bool resume) {
    simulate::RunOptions options;
    options.out = folder.path(), options.interrupt = interrupt, options.resume = resume;
    return simulate::run(scene, registry(), options).status;
  };
  ASSERT_EQ(go(once, nullptr, false), simulate::Status::done);
  ASSERT_EQ(go(twice, &at_once, false), simulate::Status::interrupted);
  ASSERT_EQ(go(twice, nullptr, true), simulate::Status::done);
  const std::string events = read_text(once.path() / "events.csv");
  EXPECT_NE(events.find("\n0,"), std::string::npos) << events;
  EXPECT_EQ(read_text(twice.path() / "events.csv"), events);
}

TEST(ResumedRun, GoesOnWithItsRowsAfterAnEndBetweenThem) {
  const Folder folder;
  for (const char* until : {"0.705", "1"}) {
    simulate::RunOptions options;
    options.out = folder.path();
    options.resume = until[0] == '1';
    const scene::Scene scene = scene::Scene::parse(struck_bar, "test.json", {{"simulate.until", until}});
    ASSERT_EQ(simulate::run(scene, registry(), options).status, simulate::Status::done);
  }
  const std::vector<double> t = read_series(folder.path() / "series.csv").at("t");
  ASSERT_EQ(t.size(), 102u);
  EXPECT_EQ(t[70], 70 * 0.01);
  EXPECT_EQ(t[71], 0.705);  // the end of the first run
  EXPECT_EQ(t[72], 71 * 0.01);
  EXPECT_EQ(t.back(), 1);
}

TEST(ResumedRun, KeepsTheLedger) {
  const Logs whole = run_in_pieces(scene::Scene::parse(struck_bar, "test.json"), 1LL << 60);
  for (const char* cause : {"lost_to_impacts", "drives", "dampers", "constraints", "contacts", "impacts"})
    EXPECT_TRUE(whole.data.contains(cause)) << cause;
}

// Whatever the watches of contacts hold, at whatever moment the run was cut.
TEST(ResumedRun, HasEachNumberOfItsWatchesBack) {
  const scene::Scene scene = scene::Scene::parse(  // a contact each of two kinds, each with numbers of its own
      struck_bar, "test.json", {{"contacts.far", R"({"type": "continuous_force", "stiffness": 1e4,
                            "between": ["bar.hinge", {"plane": {"point": [0, -9], "normal": [0, 1]}}]})"}});
  const Folder folder;
  std::filesystem::create_directories(folder.path());
  simulate::Recorder::Lengths lengths;
  nlohmann::json data;
  run_piece(scene, folder.path(), data, lengths, 20);
  nlohmann::json* const watched = find(data, "watched");
  ASSERT_TRUE(watched);
  ASSERT_EQ(watched->size() % 2, 0u);  // two watches at least
  ASSERT_FALSE(watched->empty());
  for (std::size_t i = 0; i < watched->size(); ++i) (*watched)[i] = std::bit_cast<std::uint64_t>(1.5 + double(i));
  const nlohmann::json written = *watched;
  run_piece(scene, folder.path(), data, lengths, 0);
  EXPECT_EQ(*find(data, "watched"), written);
}

}  // namespace
}  // namespace trammel::test
