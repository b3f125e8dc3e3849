// The results folder belongs to one run: locked, without links, without files of an older one; checkpoints are not
// trusted.
#include <sys/file.h>
#include <unistd.h>

#include <fcntl.h>

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;

class ResultsFolder : public testing::Test {
 protected:
  cli::Result run(std::vector<std::string> more = {}, const std::string& scene = cli::bounce) {
    std::vector<std::string> words = {"run", scene, "--out", "r"};
    words.insert(words.end(), more.begin(), more.end());
    return trammel(words, {.folder = folder.path()});
  }
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(r)) all.insert(entry.path().filename().string());
    return all;
  }

  cli::TemporaryFolder folder;
  const fs::path r = folder.path() / "r";
};

// A lock that another process holds stands for a run that writes there.
TEST_F(ResultsFolder, ThatAnotherRunWritesToIsRefused) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string series = cli::read_file(r / "series.csv");
  const int lock = ::open(r.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  for (const auto& words : {std::vector<std::string>{"run", cli::bounce, "--out", "r"},
                            {"run", cli::bounce, "--resume", "r"},
                            {"run", cli::bounce, "--out", "r/"}}) {
    const auto result = trammel(words, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("another run writes there"));
  }
  EXPECT_EQ(cli::read_file(r / "series.csv"), series);
  ::close(lock);
  EXPECT_EQ(run().exit_code, 0);
}

TEST_F(ResultsFolder, KeepsNothingOfAnOlderRunAndAllThatIsNotOfARun) {
  ASSERT_EQ(run().exit_code, 0);
  for (const char* name : {"series.csv", "events.csv", "animation.ndjson", "fields.ndjson", "result.json",
                           "checkpoint.cbor", "checkpoint.previous.cbor", "checkpoint.cbor.tmp", "notes.txt"})
    cli::write_file(r / name, "old");
  ASSERT_EQ(run().exit_code, 0);
  for (const auto& name : names()) EXPECT_EQ(cli::read_file(r / name) == "old", name == "notes.txt") << name;
  EXPECT_FALSE(names().contains("fields.ndjson"));
  EXPECT_FALSE(names().contains("checkpoint.cbor.tmp"));
}

// Each file that a command removes or overwrites, in a folder that no run has written to.
TEST_F(ResultsFolder, WithSomebodysOwnFilesIsRefused) {
  const std::string study = R"({"study": 1, "scene": ")" + cli::bounce +
                            R"(", "mode": "list", "vary": [{}], "reduce": {"y": {"observe": "height", "as": "max"}}})";
  cli::write_file(folder.path() / "of_one.json", study);
  struct Own {
    const char *command, *name;
  };
  for (const auto& [command, name] : {Own{"run", "series.csv"},
                                      {"run", "report.html"},
                                      {"run", "events.npz"},
                                      {"run", "fields.ndjson"},
                                      {"run", "result.json"},
                                      {"run", "scene.resolved.json"},
                                      {"run", "checkpoint.cbor"},
                                      {"static", "report.html"},
                                      {"modes", "modes.csv"},
                                      {"modes", "modes.json"},
                                      {"study", "study.csv"},
                                      {"study", "study.json"},
                                      {"study", "cases.ndjson"},
                                      {"trade", "choice.json"},
                                      {"trade", "trade.json"}}) {
    SCOPED_TRACE(std::string(command) + ", " + name);
    fs::remove_all(r);
    fs::create_directory(r);
    cli::write_file(r / name, R"({"mine": 1})");
    const std::string operand = std::string(command) == "study" ? "of_one.json" : cli::bounce;
    const auto result = trammel({command, operand, "--out", "r"}, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(name));
    EXPECT_THAT(result.err, HasSubstr("--out names another folder"));
    EXPECT_EQ(names(), std::set<std::string>{name});
    EXPECT_EQ(cli::read_file(r / name), R"({"mine": 1})");
  }
}

// Of a run that was killed there may be no result.
TEST_F(ResultsFolder, OfAnUnfinishedRunIsItsOwn) {
  for (const char* left : {"scene.resolved.json", "checkpoint.cbor", "result.json"}) {
    fs::remove_all(r);
    ASSERT_EQ(run().exit_code, 0);
    for (const auto& name : names())
      if (name != left && name != "series.csv") fs::remove(r / name);
    EXPECT_EQ(run().exit_code, 0) << left;
  }
}

TEST_F(ResultsFolder, OfAnotherCommandIsRefused) {
  ASSERT_EQ(run().exit_code, 0);
  const auto before = names();
  const auto result = trammel({"modes", cli::bounce, "--out", "r"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("it holds results of 'trammel run'"));
  EXPECT_EQ(names(), before);
}

// `modes` keeps the run to its state in a folder of its own.
TEST_F(ResultsFolder, OfModesDoesNotFollowALinkInPlaceOfItsRun) {
  ASSERT_EQ(run().exit_code, 0);
  const auto before = names();
  fs::create_directory(folder.path() / "m");
  fs::create_directory_symlink("../r", folder.path() / "m/run");
  for (const std::vector<std::string>& at : {std::vector<std::string>{}, {"--at", "0.1"}}) {
    std::vector<std::string> words = {"modes", cli::bounce, "--out", "m"};
    words.insert(words.end(), at.begin(), at.end());
    const auto result = trammel(words, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("it is a symbolic link"));
    EXPECT_EQ(names(), before);
  }
}

TEST_F(ResultsFolder, IsNotMadeForAnInvalidScene) {
  cli::write_file(folder.path() / "bad.json", R"({"trammel": 1, "space": "planar", "bodies": {}})");
  for (const char* command : {"run", "static", "modes"}) {
    const auto result = trammel({command, "bad.json", "--out", "new/r"}, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_FALSE(fs::exists(folder.path() / "new")) << command;
  }
}

TEST_F(ResultsFolder, OfAnOlderRunStaysAsItIsForAnInvalidScene) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string result = cli::read_file(r / "result.json");
  EXPECT_EQ(run({"--set", "bodies.ball.mass=0"}).exit_code, 2);
  EXPECT_EQ(cli::read_file(r / "result.json"), result);
}

// Each file of a run, led away: the run makes its own, and what the link leads to stays.
TEST_F(ResultsFolder, FollowsNoSymbolicLinks) {
  cli::write_file(folder.path() / "precious", "precious");
  for (const char* name : {"series.csv", "events.csv", "animation.ndjson", "result.json", "result.json.tmp",
                           "checkpoint.cbor", "checkpoint.cbor.tmp", "checkpoint.previous.cbor", ".reserve"}) {
    fs::remove_all(r);
    ASSERT_EQ(run().exit_code, 0);
    fs::remove(r / name);
    fs::create_symlink("../precious", r / name);
    EXPECT_EQ(run().exit_code, 0) << name;
    EXPECT_EQ(cli::read_file(folder.path() / "precious"), "precious") << name;
  }
  fs::remove_all(r);
  fs::create_directory(folder.path() / "elsewhere");
  fs::create_directory_symlink("elsewhere", r);
  const auto result = run();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("symbolic link"));
  EXPECT_TRUE(fs::is_empty(folder.path() / "elsewhere"));
}

TEST_F(ResultsFolder, FollowsNoSymbolicLinksWhenItIsResumed) {
  ASSERT_EQ(run().exit_code, 0);
  fs::copy_file(r / "series.csv", folder.path() / "precious");
  fs::remove(r / "series.csv");
  fs::create_symlink("../precious", r / "series.csv");
  EXPECT_EQ(
      trammel({"run", cli::bounce, "--resume", "r", "--set", "simulate.until=2"}, {.folder = folder.path()}).exit_code,
      2);
  fs::remove(r / "series.csv");
  EXPECT_EQ(cli::read_file(folder.path() / "precious").back(), '\n');
}

// --- resuming after a loss of power ---

class AfterLossOfPower : public ResultsFolder {
 protected:
  // Two checkpoints: at 0.5 s and at 1 s.
  void SetUp() override {
    ASSERT_EQ(run({"--set", "simulate.until=0.5"}).exit_code, 0);
    ASSERT_EQ(resume(1).exit_code, 0);
    ASSERT_TRUE(fs::exists(r / "checkpoint.previous.cbor"));
  }
  cli::Result resume(double until) {
    return trammel({"run", cli::bounce, "--resume", "r", "--set", "simulate.until=" + std::to_string(until)},
                   {.folder = folder.path()});
  }
  // The whole run, stopped at the same times, which its rows show.
  void expect_bytes_of_a_run_that_was_not_broken() {
    const auto at = [&](double until, const std::vector<std::string>& where) {
      std::vector<std::string> words = {"run", cli::bounce, "--set", "simulate.until=" + std::to_string(until)};
      words.insert(words.end(), where.begin(), where.end());
      ASSERT_EQ(trammel(words, {.folder = folder.path()}).exit_code, 0);
    };
    at(0.5, {"--out", "whole"}), at(1, {"--resume", "whole"}), at(2, {"--resume", "whole"});
    for (const char* log : {"series.csv", "events.csv"})
      EXPECT_TRUE(cli::read_file(r / log) == cli::read_file(folder.path() / "whole" / log)) << log;
  }
  static void fill_with_zeros(const fs::path& file, std::size_t from) {
    std::string text = cli::read_file(file);
    std::fill(text.begin() + std::ptrdiff_t(std::min(from, text.size())), text.end(), '\0');
    cli::write_file(file, text);
  }
};

TEST_F(AfterLossOfPower, TheCheckpointBeforeServesForADamagedOne) {
  fill_with_zeros(r / "checkpoint.cbor", 100);
  const auto resumed = resume(1);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.out, HasSubstr("went on from checkpoint.previous.cbor"));
  ASSERT_EQ(resume(2).exit_code, 0);
  expect_bytes_of_a_run_that_was_not_broken();
}

TEST_F(AfterLossOfPower, TheCheckpointBeforeServesForAMissingOne) {
  fs::remove(r / "checkpoint.cbor");
  EXPECT_EQ(resume(1).exit_code, 0);
}

TEST_F(AfterLossOfPower, ZerosInTheLastPartOfALogAreFoundAndWrittenAnew) {
  fill_with_zeros(r / "series.csv", cli::read_file(r / "series.csv").size() - 200);
  ASSERT_EQ(resume(1).exit_code, 0);
  ASSERT_EQ(resume(2).exit_code, 0);
  expect_bytes_of_a_run_that_was_not_broken();
}

TEST_F(AfterLossOfPower, ZerosAnywhereInALogAreNeverAccepted) {
  const std::string whole = cli::read_file(r / "series.csv");
  // The first checkpoint was written after half of it: earlier damage leaves nothing to go on from.
  for (const std::size_t from : {std::size_t(0), whole.size() / 10, whole.size() / 3}) {
    fill_with_zeros(r / "series.csv", from);
    const auto resumed = resume(2);
    EXPECT_EQ(resumed.exit_code, 2);
    EXPECT_THAT(resumed.err, HasSubstr("series.csv are not those that were written before the checkpoint"));
    cli::write_file(r / "series.csv", whole);
  }
  fs::resize_file(r / "events.csv", 10);
  EXPECT_THAT(resume(2).err, HasSubstr("events.csv has 10 bytes"));
}

}  // namespace
