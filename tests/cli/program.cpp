#include "program.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

// In the child: from here to exec only what POSIX allows after fork.
[[noreturn]] void become(const fs::path& program, const std::vector<std::string>& words, const Setting& setting,
                         int out, int err) {
  if (!setting.stdout_to.empty()) out = open(setting.stdout_to.c_str(), O_WRONLY);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  if (chdir(setting.folder.c_str()) != 0) _exit(126);
  for (const auto& [name, value] : setting.environment) setenv(name.c_str(), value.c_str(), 1);
  if (setting.file_size_limit) {
    const auto bytes = static_cast<rlim_t>(*setting.file_size_limit);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

// Reads what is there; false at the end of the stream.
bool drain(int from, std::string& to) {
  std::array<char, 65536> buffer;
  const ssize_t n = read(from, buffer.data(), buffer.size());
  if (n <= 0) return false;
  to.append(buffer.data(), static_cast<std::size_t>(n));
  return true;
}

}  // namespace

Result run_program(const fs::path& program, const std::vector<std::string>& words, const Setting& setting) {
  std::array<int, 2> out, err;
  const int failed =
      setting.terminal ? openpty(&err[0], &err[1], nullptr, nullptr, nullptr) : pipe2(err.data(), O_CLOEXEC);
  if (failed || pipe2(out.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become(program, words, setting, out[1], err[1]);
  close(out[1]);
  close(err[1]);

  Result result;
  bool signal_sent = false;
  std::optional<std::chrono::time_point<Clock, std::chrono::duration<double>>> again;
  std::array<pollfd, 2> streams{pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
  const auto deadline = Clock::now() + std::chrono::duration<double>(setting.time_limit);
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    poll(streams.data(), streams.size(), 2);
    if (streams[0].revents && !drain(out[0], result.out)) streams[0].fd = -1;
    if (streams[1].revents && !drain(err[0], result.err)) streams[1].fd = -1;
    if (setting.send_signal_when && !signal_sent && setting.send_signal_when()) {
      kill(child, setting.signal);
      signal_sent = true;
      if (setting.again_after > 0) again = Clock::now() + std::chrono::duration<double>(setting.again_after);
    }
    if (again && Clock::now() > *again) {
      kill(child, setting.signal);
      again.reset();
    }
    if (Clock::now() > deadline) kill(child, SIGKILL);
  }
  close(out[0]);
  close(err[0]);
  int status = 0;
  waitpid(child, &status, 0);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return result;
}

Result trammel(const std::vector<std::string>& words, const Setting& setting) {
  return run_program(fs::path(TRAMMEL_BUILD_DIR) / "bin" / "trammel", words, setting);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "trammel_test_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace cli
