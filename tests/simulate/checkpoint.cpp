// A run that is cut and resumed gives the bytes of one that was not.
//
// The program's side of it, signals and files, is in tests/cli/interruption.cpp; here runs are cut after exact numbers of steps.
#include <optional>

#include "run_scene.hpp"
#include "scenes.hpp"
#include "simulate/checkpoint.hpp"
#include "simulate/setup.hpp"
#include "simulate/simulator.hpp"

namespace trammel::test {
namespace {

using simulate::JsonArchive;
using simulate::Recorder;

// One piece of a run: a fresh set-up, resumed from `data` if there is any, for so many steps.
struct Piece {
  bool ended = false;
  bool in_contact = false;
  long long steps = 0;
};

Piece run_piece(const scene::Scene& scene, const std::filesystem::path& folder, nlohmann::json& data,
                Recorder::Lengths& lengths, long long most_steps) {
  simulate::Setup setup = simulate::set_up(scene, registry());
  simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
  const auto exchange = [&](JsonArchive::Direction direction) {
    JsonArchive archive(data, direction);
    simulator.archive(archive);
    JsonArchive nested = archive.nested("integrator");
    setup.integrator->archive(nested);
  };
  std::optional<Recorder> recorder;
  if (data.is_null()) {
    recorder.emplace(folder, *setup.model, setup.columns, std::nullopt);
    simulator.start(setup.initial);
  } else {
    recorder.emplace(folder, *setup.model, setup.columns, lengths);
    exchange(JsonArchive::Direction::read);
    simulator.resume();
  }
  Piece piece;
  while (most_steps-- > 0 && !piece.ended) piece.ended = !simulator.advance(*recorder);
  recorder->flush();
  lengths = recorder->lengths();
  data = nlohmann::json::object();
  exchange(JsonArchive::Direction::write);
  data = nlohmann::json::from_cbor(nlohmann::json::to_cbor(data));  // as the file holds it
  piece.steps = simulator.statistics().steps;
  for (const auto& mode : simulator.system().modes().contacts) piece.in_contact = piece.in_contact || mode.closed;
  return piece;
}

struct Logs {
  std::string series, events;
  nlohmann::json data;
  long long steps = 0;
  int cuts_in_contact = 0;
};

// Cut after every `stride` steps.
Logs run_in_pieces(const scene::Scene& scene, long long stride) {
  const Folder folder;
  std::filesystem::create_directories(folder.path());
  Logs logs;
  Recorder::Lengths lengths;
  for (Piece piece; !piece.ended;) {
    piece = run_piece(scene, folder.path(), logs.data, lengths, stride);
    logs.steps = piece.steps;
    logs.cuts_in_contact += piece.in_contact;
  }
  for (const char* work : {"factorizations", "residual_evaluations"})
    logs.data.erase(work);  // each piece begins with some
  logs.series = read_text(folder.path() / "series.csv");
  logs.events = read_text(folder.path() / "events.csv");
  return logs;
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
  EXPECT_TRUE(pieces.data == whole.data);  // and so would all that follows
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
  EXPECT_TRUE(pieces.data == whole.data);
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
