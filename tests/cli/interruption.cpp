// Ctrl-C, SIGTERM, kill -9: results are kept, and the resumed run ends with the same bytes as one that was never
// stopped.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using cli::trammel;
using nlohmann::json;
using testing::HasSubstr;

// No machine reaches this end before the signal comes.
constexpr double kFarAway = 1e6;  // [s]

// `option` is --out or --resume.
std::vector<std::string> run_of(const std::string& scene, const std::string& option, const std::string& folder,
                                double until) {
  return {"run", (cli::scenes / scene).string(), option, folder, "--set", "simulate.until=" + std::to_string(until)};
}

// The time of the last whole row; 0 if there is none yet.
double last_time(const std::string& series) {
  const auto end = series.rfind('\n');
  const auto start = end == std::string::npos || end == 0 ? std::string::npos : series.rfind('\n', end - 1);
  return start == std::string::npos ? 0 : std::stod(series.substr(start + 1));
}

// Interrupts a run as soon as `file` of its results exists, then resumes it to an end 5 s later.
struct Interruption {
  std::string scene;
  std::string file;
  int signal;
  int exit_code;
};

void PrintTo(const Interruption& i, std::ostream* out) {
  *out << i.scene << ", signal " << i.signal;
}

class Interrupted : public testing::TestWithParam<Interruption> {};

TEST_P(Interrupted, RunResumesToTheSameBytes) {
  const auto& [scene, file, signal, exit_code] = GetParam();
  const cli::TemporaryFolder folder;
  cli::Setting setting{.folder = folder.path()};
  setting.signal = signal;
  setting.send_signal_when = [&] { return fs::exists(folder.path() / "broken" / file); };
  const auto stopped = trammel(run_of(scene, "--out", "broken", kFarAway), setting);
  ASSERT_EQ(stopped.exit_code, exit_code) << stopped.err;
  setting.send_signal_when = {};
  const double end = std::floor(last_time(cli::read_file(folder.path() / "broken/series.csv"))) + 5;

  const auto resumed = trammel(run_of(scene, "--resume", "broken", end), setting);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  const auto whole = trammel(run_of(scene, "--out", "whole", end), setting);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  for (const char* log : {"series.csv", "events.csv"})
    EXPECT_EQ(cli::read_file(folder.path() / "broken" / log), cli::read_file(folder.path() / "whole" / log)) << log;
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupted,
                         testing::Values(Interruption{"long_bounce.json", "series.csv", SIGINT, 130},
                                         Interruption{"long_pendulum.json", "series.csv", SIGINT, 130},
                                         Interruption{"long_bounce.json", "series.csv", SIGTERM, 130},
                                         Interruption{"long_bounce.json", "checkpoint.cbor", SIGKILL, -SIGKILL},
                                         Interruption{"long_pendulum.json", "checkpoint.cbor", SIGKILL, -SIGKILL}));

class Interrupt : public testing::Test {
 protected:
  cli::Result stop_early(std::vector<std::string> more = {}) {
    auto words = run_of("long_bounce.json", "--out", "broken", kFarAway);
    words.insert(words.end(), more.begin(), more.end());
    return trammel(words, {.folder = folder.path(),
                           .send_signal_when = [this] { return fs::exists(folder.path() / "broken/series.csv"); }});
  }
  cli::TemporaryFolder folder;
};

TEST_F(Interrupt, SaysHowToContinue) {
  const auto result = stop_early();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("--resume broken"));
}

// Through a shell, as a person would paste it; with an end that is reached.
TEST_F(Interrupt, SaysACommandThatContinues) {
  const auto result = stop_early({"--set", "bodies.ball.mass=2.5", "--set", "title=it's \"here\" & $now"});
  ASSERT_EQ(result.exit_code, 130) << result.err;
  const std::string mark = "continue with: ";
  std::string command = result.err.substr(result.err.find(mark) + mark.size());
  command.resize(command.find('\n'));
  EXPECT_THAT(command, HasSubstr("bodies.ball.mass=2.5"));
  const double end = std::floor(last_time(cli::read_file(folder.path() / "broken/series.csv"))) + 5;
  const auto resumed = cli::run_program("/bin/sh", {"-c", command + " --set simulate.until=" + std::to_string(end)},
                                        {.folder = folder.path()});
  EXPECT_EQ(resumed.exit_code, 0) << command << "\n" << resumed.err;
}

TEST_F(Interrupt, LeavesAResultThatSaysSo) {
  const auto result = stop_early({"--json"});
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_EQ(json::parse(result.out)["status"], "interrupted");
  EXPECT_EQ(json::parse(cli::read_file(folder.path() / "broken/result.json"))["status"], "interrupted");
}

TEST_F(Interrupt, DoesNotResumeWithAnotherScene) {
  ASSERT_EQ(stop_early().exit_code, 130);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", (cli::scenes / "pendulum.json").string(), "--resume", "broken"},
        {"run", (cli::scenes / "long_bounce.json").string(), "--resume", "broken", "--set", "bodies.ball.mass=2"}}) {
    const auto result = trammel(words, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr("scene"));
  }
}

TEST_F(Interrupt, DoesNotResumeFromADamagedCheckpoint) {
  ASSERT_EQ(stop_early().exit_code, 130);
  const fs::path checkpoint = folder.path() / "broken/checkpoint.cbor";
  fs::resize_file(checkpoint, fs::file_size(checkpoint) / 2);
  const auto result =
      trammel({"run", (cli::scenes / "long_bounce.json").string(), "--resume", "broken"}, {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("checkpoint.cbor"));
}

}  // namespace
