#include "plugin/rehearsal.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <string>

#include "plugin/plugin_error.hpp"

namespace trammel::plugin {

namespace {

constexpr int report_to = 3;  // where the child's end of the pipe is

[[noreturn]] void report_and_end(const char* text) {
  const auto written = ::write(report_to, text, std::strlen(text));
  ::_exit(written < 0 ? 2 : 1);
}

// Runs in the child in place of std::terminate's message and abort.
[[noreturn]] void report_exception() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::exception& e) {
    report_and_end(fmt::format("it threw while it was loaded: {}", e.what()).c_str());
  } catch (...) {
    report_and_end("it threw something that is no std::exception while it was loaded");
  }
  report_and_end("it ended the program (std::terminate) while it was loaded");
}

// Never returns: whatever happens here, the parent reads it from the pipe or from the way the child ended. An exception may
// come through the loader's frames or end there; noexcept makes both end in report_exception.
[[noreturn]] void child(const char* file, int pipe_end) noexcept {
  ::dup2(pipe_end, report_to);
  if (const int silence = ::open("/dev/null", O_RDWR); silence >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(silence, standard);
  for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT}) std::signal(fatal, SIG_DFL);
  std::set_terminate(report_exception);
  if (!::dlopen(file, RTLD_NOW | RTLD_LOCAL)) report_and_end(::dlerror());
  report_and_end("ok");
}

std::string read_report(int pipe_end, std::chrono::milliseconds limit) {
  std::string report;
  std::array<char, 512> buffer;
  for (;;) {
    pollfd ready{pipe_end, POLLIN, 0};
    const int answer = ::poll(&ready, 1, static_cast<int>(limit.count()));
    if (answer < 0 && errno == EINTR) continue;
    if (answer <= 0) return fmt::format("it did not finish loading within {} ms", limit.count());
    const auto count = ::read(pipe_end, buffer.data(), buffer.size());
    if (count <= 0) return report;
    report.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

void rehearse_loading(const std::filesystem::path& file, std::chrono::milliseconds limit) {
  const std::string name = file.string();
  std::array<int, 2> pipe_ends;
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw PluginError(name, fmt::format("cannot be tried out: {}", std::strerror(errno)));
  const pid_t process = ::fork();
  if (process == 0) child(name.c_str(), pipe_ends[1]);
  ::close(pipe_ends[1]);
  if (process < 0) {
    ::close(pipe_ends[0]);
    throw PluginError(name, fmt::format("cannot be tried out: {}", std::strerror(errno)));
  }
  const std::string report = read_report(pipe_ends[0], limit);
  ::close(pipe_ends[0]);
  if (report != "ok") ::kill(process, SIGKILL);  // it may still be running
  const int status = wait_for(process);

  if (report == "ok") return;
  if (!report.empty()) throw PluginError(name, report);
  if (WIFSIGNALED(status))
    throw PluginError(name, fmt::format("it crashes while it is loaded: {}", ::strsignal(WTERMSIG(status))));
  throw PluginError(name, fmt::format("it ends the program with code {} while it is loaded", WEXITSTATUS(status)));
}

}  // namespace trammel::plugin
