// Ctrl-C, SIGTERM, SIGHUP, limits of time, kill -9: results are kept, and the resumed run ends with the same bytes as
// one that was never stopped.
#include <chrono>
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
                                         Interruption{"long_bounce.json", "series.csv", SIGHUP, 130},
                                         Interruption{"long_pendulum.json", "series.csv", SIGXCPU, 130},
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

// A command of the shell, in which $0 is the program.
cli::Result by_shell(const std::string& command, const cli::Setting& setting) {
  const std::string program = (fs::path(TRAMMEL_BUILD_DIR) / "bin/trammel").string();
  return cli::run_program("/bin/sh", {"-c", command, program}, setting);
}

std::string status_in(const fs::path& folder) {
  return json::parse(cli::read_file(folder / "result.json"))["status"];
}

// What nohup does, and a shell for what it starts in the background.
TEST_F(Interrupt, LeavesSignalsAloneThatAreIgnored) {
  for (const auto& [name, signal] : {std::pair{"HUP", SIGHUP}, {"INT", SIGINT}, {"TERM", SIGTERM}}) {
    const std::string run = (cli::scenes / "long_bounce.json").string() + " --out ignored --set simulate.until=20";
    const auto result =
        by_shell("trap '' " + std::string(name) + "; exec \"$0\" run " + run,
                 {.folder = folder.path(),
                  .send_signal_when = [this] { return fs::exists(folder.path() / "ignored/series.csv"); },
                  .signal = signal});
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
    EXPECT_EQ(status_in(folder.path() / "ignored"), "done");
    fs::remove_all(folder.path() / "ignored");
  }
}

// The system sends SIGXCPU every second then, until the run has stopped.
TEST_F(Interrupt, ComesWithTheLimitOfCpuTime) {
  const auto result = by_shell("ulimit -S -t 1; exec \"$0\" run " + (cli::scenes / "long_bounce.json").string() +
                                   " --out limited --set simulate.until=1e6",
                               {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_EQ(status_in(folder.path() / "limited"), "interrupted");
  EXPECT_TRUE(fs::exists(folder.path() / "limited/checkpoint.cbor"));
}

// `timeout` sends its signal to the program and then to its group: twice within a millisecond.
TEST_F(Interrupt, ByTimeoutIsOneRequest) {
  const auto result = by_shell("exec timeout 1 \"$0\" run " + (cli::scenes / "long_bounce.json").string() +
                                   " --out limited --set simulate.until=1e6",
                               {.folder = folder.path()});
  EXPECT_EQ(result.exit_code, 124) << result.err;  // timeout's own
  EXPECT_EQ(status_in(folder.path() / "limited"), "interrupted");
  EXPECT_TRUE(fs::exists(folder.path() / "limited/checkpoint.cbor"));
  EXPECT_THAT(result.err, HasSubstr("continue with"));
}

// A step that does not return: the second signal ends it, or patience does. The records are kept, the culprit is named.
TEST_F(Interrupt, EndsAStepThatDoesNotReturn) {
  const std::string library = (fs::path(TRAMMEL_BUILD_DIR) / "tests/plugins/never_returns.so").string();
  for (const auto& [how, again] : {std::pair{"wait", 0.0}, {"spin", 0.0}, {"wait", 0.6}, {"spin", 0.6}}) {
    const auto began = std::chrono::steady_clock::now();
    const auto result =
        trammel({"run", cli::bounce, "--out", "hanging", "--plugin", library, "--set",
                 R"(corrections.position={"type": "never_returns", "how": ")" + std::string(how) + "\"}"},
                {.folder = folder.path(),
                 // Late enough that the call hangs already.
                 .send_signal_when = [&] { return std::chrono::steady_clock::now() - began > std::chrono::seconds(2); },
                 .again_after = again});
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted at t = "));
    EXPECT_THAT(result.err, HasSubstr(again > 0 ? "by a second signal" : "5 s after the signal"));
    EXPECT_THAT(result.err,
                HasSubstr("it was in plugin " + library + ": correction never_returns (corrections.position): apply"));
    EXPECT_EQ(status_in(folder.path() / "hanging"), "interrupted");
    const std::string series = cli::read_file(folder.path() / "hanging/series.csv");
    EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 1 + 50) << series;  // header; 0 to 0.49 s
  }
}

// Files of the results would be opened in their place, and messages written into them.
TEST(ClosedDescriptors, AreNoPlaceForResults) {
  const cli::TemporaryFolder folder;
  const std::string run = "exec \"$0\" run " + cli::bounce + " --out ";
  ASSERT_EQ(by_shell(run + "plain", {.folder = folder.path()}).exit_code, 0);
  for (const char* closed : {"<&-", ">&-", "2>&-", ">&- 2>&-", "<&- >&-", "<&- 2>&-", "<&- >&- 2>&-"}) {
    const auto result = by_shell(run + "closed " + closed, {.folder = folder.path()});
    EXPECT_EQ(result.exit_code, 0) << closed << result.err;
    for (const char* log : {"series.csv", "events.csv", "animation.ndjson"})
      EXPECT_EQ(cli::read_file(folder.path() / "closed" / log), cli::read_file(folder.path() / "plain" / log))
          << closed;
    EXPECT_EQ(status_in(folder.path() / "closed"), "done") << closed;
    fs::remove_all(folder.path() / "closed");
  }
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
