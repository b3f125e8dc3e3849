// A run that is cut and resumed gives the bytes of one that was not.
//
// The program's side of it, signals and files, is in tests/cli/interruption.cpp; here runs are cut after exact numbers of steps.
#include <atomic>

#include "run_in_pieces.hpp"
#include "scenes.hpp"

namespace trammel::test {
namespace {

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

TEST(ResumedRun, InsideACompliantContactEndsWithTheSameBytes) {
  const scene::Scene scene = scene::Scene::parse(
      ball, "test.json", {{"contacts.floor", R"({"type": "continuous_force", "stiffness": 1e4, "restitution": 0.8,
        "between": ["ball.point", {"plane": {"point": [0, 0], "normal": [0, 1]}}]})"}});
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 7);
  EXPECT_GT(pieces.cuts_in_contact, 0);
  EXPECT_TRUE(pieces.series == whole.series);
  EXPECT_TRUE(pieces.events == whole.events);
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
  std::atomic<bool> at_once = true;
  const auto go = [&](const Folder& folder, std::atomic<bool>* interrupt, bool resume) {
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

}  // namespace
}  // namespace trammel::test
