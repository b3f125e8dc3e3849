// Runs build/bin/trammel as a user does: a child process with its own folder, its output collected.
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

// Scenes that are run in a moment.
inline const std::filesystem::path scenes = std::filesystem::path(TRAMMEL_SOURCE_DIR) / "tests/cli/scenes";
inline const std::string bounce = (scenes / "bounce.json").string();
inline const std::string pendulum = (scenes / "pendulum.json").string();

struct Setting {
  std::filesystem::path folder = ".";                                 // working folder of the child
  std::vector<std::pair<std::string, std::string>> environment = {};  // added to ours
  std::optional<long> file_size_limit = {};                           // [bytes] RLIMIT_FSIZE: a full disk
  std::string stdout_to = {};                                         // a file instead of a pipe, e.g. /dev/full
  bool terminal = false;                                              // standard error is a terminal
  // Asked every few milliseconds; true: the signal is sent (once).
  std::function<bool()> send_signal_when = {};
  int signal = SIGINT;
  double again_after = 0;  // [s] then it is sent once more; 0: never
  double time_limit = 60;  // [s] then the child is killed, and `exit_code` is -SIGKILL
};

struct Result {
  int exit_code = 0;  // negative: ended by that signal
  std::string out, err;
};

// "trammel" with these words.
Result trammel(const std::vector<std::string>& words, const Setting& setting = {});
Result run_program(const std::filesystem::path& program, const std::vector<std::string>& words,
                   const Setting& setting = {});

// A folder of its own for one test, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<std::string> lines(const std::string& text);
std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace cli
