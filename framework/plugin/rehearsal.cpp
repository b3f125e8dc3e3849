#include "plugin/rehearsal.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <trammel/plugin.hpp>

#include "plugin/plugin_error.hpp"
#include "scene/no_memory.hpp"

namespace trammel::plugin {

namespace {

using Clock = std::chrono::steady_clock;

// --- the child ---

// The child writes a letter and a text, terminated by '\0'.
enum Message : char { stage = 's', sound = '.', refused = 'r', no_memory = 'm' };

// A global variable, because the run-time library calls these functions without arguments.
int report_to = -1;

void report(Message message, const char* text) {
  const std::size_t size = std::strlen(text) + 1;
  const char letter = message;
  if (::write(report_to, &letter, 1) < 0 || ::write(report_to, text, size) < 0) ::_exit(2);
}

[[noreturn]] void report_and_end(Message message, const char* text) {
  report(message, text);
  ::_exit(1);
}

[[noreturn]] void report_no_memory() {
  report_and_end(no_memory, "");
}

// Replaces the message and abort of std::terminate.
[[noreturn]] void report_exception() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    report_no_memory();
  } catch (const std::exception& e) {
    report_and_end(refused, fmt::format("it threw while it was loaded: {}", e.what()).c_str());
  } catch (...) {
    report_and_end(refused, "it threw something that is no std::exception while it was loaded");
  }
  report_and_end(refused, "it ended the program (std::terminate) while it was loaded");
}

const Declarations& declared(void* library) {
  using EntryPoint = const Declarations*();
  const auto entry = reinterpret_cast<EntryPoint*>(::dlsym(library, entry_point));
  if (!entry)
    report_and_end(refused,
                   fmt::format("it exports no function {}; is it hidden by a linker script?", entry_point).c_str());
  report(stage, "while it declares its components");
  try {
    return *entry();
  } catch (const std::bad_alloc&) {
    report_no_memory();
  } catch (const std::exception& e) {
    report_and_end(refused, fmt::format("it threw while declaring its components: {}", e.what()).c_str());
  } catch (...) {
    report_and_end(refused, "it threw something that is no std::exception while declaring its components");
  }
}

void make_each(const Declarations& declarations) {
  for (const Declaration& declaration : declarations) try {
      report(stage,
             fmt::format("in the constructor of {} \"{}\"", to_string(declaration.kind), declaration.name).c_str());
      declaration.make();
    } catch (...) {
      // The same exception is caught and reported when a scene uses the component.
    }
}

void prepare_child(int pipe_end) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  // A high descriptor, which a library is unlikely to use. Programs that the library starts inherit it, which shows
  // that they are still running.
  report_to = ::fcntl(pipe_end, F_DUPFD, 200);
  if (report_to < 0) report_to = ::dup(pipe_end);
  // A library that writes to every descriptor then damages no file of the program, and no closed pipe ends it.
  ::close_range(STDERR_FILENO + 1, unsigned(report_to) - 1, 0);
  ::close_range(unsigned(report_to) + 1, ~0U, 0);
  if (const int silence = ::open("/dev/null", O_RDWR); silence >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(silence, standard);
  for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGALRM})
    std::signal(fatal, SIG_DFL);
  std::set_terminate(report_exception);
  std::set_new_handler(report_no_memory);
}

// Never returns: the parent reads the result from the pipe or from the child's exit status. An exception may or may not
// pass the loader's stack frames; with noexcept both cases end in report_exception.
[[noreturn]] void child(const char* file, int pipe_end) noexcept {
  prepare_child(pipe_end);
  void* const library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) report_and_end(refused, ::dlerror());
  make_each(declared(library));
  report_and_end(sound, "");
}

// --- the parent ---

// Reads the child's report until it ends or the time is over.
class Listener {
 public:
  Listener(int pipe_end, pid_t child, Clock::time_point deadline)
      : pipe_end_(pipe_end), child_(child), deadline_(deadline) {
    ::fcntl(pipe_end, F_SETFL, O_NONBLOCK);
  }

  void listen() {
    for (;;) {
      drain();
      if (verdict_) return;
      if (ended()) return drain();  // read the rest
      if (Clock::now() >= deadline_) return void(in_time_ = false);
      wait(10);
    }
  }

  // If the pipe's other end is still open after the child has ended, the child started other processes. They may end
  // soon.
  bool left_a_process() {
    const auto soon = Clock::now() + std::chrono::milliseconds(200);
    for (drain(); open_ && Clock::now() < soon; drain()) wait(10);
    return open_;
  }

  bool in_time() const { return in_time_; }
  char verdict() const { return verdict_; }  // 0: none received
  const std::string& cause() const { return text_; }
  const std::string& stage() const { return stage_; }

 private:
  void wait(int milliseconds) {
    pollfd ready{open_ ? pipe_end_ : -1, POLLIN, 0};
    ::poll(&ready, 1, milliseconds);
  }

  void drain() {
    std::array<char, 512> buffer;
    while (open_) {
      const auto count = ::read(pipe_end_, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count == 0) open_ = false;
      if (count <= 0) return;
      for (const char c : std::string_view(buffer.data(), std::size_t(count))) take(c);
    }
  }

  void take(char c) {
    if (verdict_) return;
    if (c != '\0') return void(message_ += c);
    if (message_.empty()) return;
    if (message_[0] == Message::stage) {
      stage_ = message_.substr(1);
    } else {
      verdict_ = message_[0];
      text_ = message_.substr(1);
    }
    message_.clear();
  }

  bool ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, id_t(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child_;
  }

  int pipe_end_;
  pid_t child_;
  Clock::time_point deadline_;
  bool open_ = true, in_time_ = true;
  std::string message_, stage_ = "while it is loaded", text_;
  char verdict_ = 0;
};

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

// The system cannot create a process or pipe, which is not an error of the library.
[[noreturn]] void fail(const std::string& file) {
  scene::require_memory(errno);
  throw std::system_error(errno, std::generic_category(), fmt::format("cannot try out the plugin {}", file));
}

std::string refusal(const Listener& heard, int status, std::chrono::milliseconds limit) {
  if (heard.verdict() == sound) return "";
  if (heard.verdict()) return heard.cause().empty() ? "it cannot be loaded" : heard.cause();
  if (!heard.in_time()) return fmt::format("it did not finish within {} ms {}", limit.count(), heard.stage());
  if (WIFSIGNALED(status)) return fmt::format("it crashes {}: {}", heard.stage(), ::strsignal(WTERMSIG(status)));
  return fmt::format("it ends the program with code {} {}", WEXITSTATUS(status), heard.stage());
}

// The loader's message is "cannot allocate memory", or "out of memory" if it had none for the message itself.
bool lacks_memory(const Listener& heard) {
  if (heard.verdict() == no_memory) return true;
  return heard.verdict() == refused && tells_of_no_memory(heard.cause());
}

}  // namespace

bool tells_of_no_memory(std::string_view loader_message) {
  return loader_message.find(std::strerror(ENOMEM)) != loader_message.npos ||
         loader_message.find("out of memory") != loader_message.npos;
}

void rehearse(const std::filesystem::path& file, std::chrono::milliseconds limit) {
  const std::string name = file.string();
  std::array<int, 2> pipe_ends;
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) fail(name);
  const pid_t process = ::fork();
  if (process == 0) child(name.c_str(), pipe_ends[1]);
  ::close(pipe_ends[1]);
  if (process < 0) {
    ::close(pipe_ends[0]);
    fail(name);
  }
  ::setpgid(process, process);  // the child does this, too, because either may run first
  Listener heard(pipe_ends[0], process, Clock::now() + limit);
  heard.listen();
  if (heard.verdict() || !heard.in_time()) ::kill(process, SIGKILL);
  const int status = wait_for(process);
  const bool left_a_process = heard.left_a_process();
  ::kill(-process, SIGKILL);
  ::close(pipe_ends[0]);

  if (lacks_memory(heard)) throw std::bad_alloc();
  if (const std::string cause = refusal(heard, status, limit); !cause.empty()) throw PluginError(name, cause);
  if (left_a_process) throw PluginError(name, "it starts a process while it is loaded that goes on when this one ends");
}

}  // namespace trammel::plugin
