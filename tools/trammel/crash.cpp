#include "crash.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "arguments.hpp"

namespace trammel::tool {

namespace {

// Handlers of signals and of the program's end have no other way to reach the run.
simulate::CrashWitness the_witness;
bool as_json = false;
std::atomic<bool> in_the_midst = false;
pid_t this_process = 0;                   // not a child that tries out a library
std::array<char, 1 << 16> handler_stack;  // a run that overflowed its own stack leaves none

const char* what_happened(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "it read or wrote memory that is not its own, or ran out of stack (SIGSEGV)";
    case SIGBUS:
      return "it read or wrote memory that is not there (SIGBUS)";
    case SIGILL:
      return "it ran an instruction that this processor does not have (SIGILL)";
    case SIGFPE:
      return "it divided an integer by zero (SIGFPE)";
    default:
      return "it aborted (SIGABRT)";
  }
}

// Text in a fixed place: a crashed process may not allocate. What does not fit is cut off.
class Line {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    const auto end = fmt::format_to_n(text_.data() + size_, text_.size() - size_, format, std::forward<Args>(args)...);
    size_ = std::size_t(end.out - text_.data());
  }
  std::string_view text() const { return {text_.data(), size_}; }

 private:
  std::array<char, 2048> text_;
  std::size_t size_ = 0;
};

void put(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(std::size_t(n));
  }
}

void put_json(std::string_view message) {
  put(STDOUT_FILENO,
      R"({"status": "error", "problems": [{"file": "", "line": 0, "column": 0, "path": "", "message": ")");
  for (const char c : message) {
    if (c == '"' || c == '\\') put(STDOUT_FILENO, "\\");
    put(STDOUT_FILENO, {&c, 1});
  }
  put(STDOUT_FILENO, "\"}]}\n");
}

// Says who ended the process and how; ends it.
[[noreturn]] void tell_and_end(const char* how) {
  the_witness.rescue();
  const simulate::CrashWitness::Culprit who = the_witness.culprit();
  Line line;
  if (who.origin) {
    line.add("plugin {}: {}", who.origin->file, who.origin->component);
    if (!who.origin->path.empty()) line.add(" ({})", who.origin->path);
    line.add(": {}{}", who.call, who.certain ? "" : ", or the program on its behalf,");
  } else {
    line.add("the program ended where no plugin is known to be called");
  }
  if (who.t) line.add(" at t = {:.9g} s", *who.t);
  if (who.step) line.add(", step {}", *who.step);
  line.add(": {}", how);
  if (as_json) {
    put_json(line.text());
  } else {
    put(STDERR_FILENO, "trammel: ");
    put(STDERR_FILENO, line.text());
    put(STDERR_FILENO, "\n");
  }
  ::_exit(static_cast<int>(who.origin ? Exit::bad_plugin : Exit::failed));
}

void on_crash(int signal) {
  std::signal(signal, SIG_DFL);  // a second crash, in here, ends the process
  tell_and_end(what_happened(signal));
}

void on_exit() {
  if (in_the_midst && ::getpid() == this_process) tell_and_end("it ended the program (exit), which no plugin may");
}

}  // namespace

simulate::CrashWitness& witness() {
  return the_witness;
}

void ends_by_itself() {
  in_the_midst = false;
}

void watch_for_crashes(bool json) {
  as_json = json;
  this_process = ::getpid();
  in_the_midst = true;
  std::atexit(on_exit);
  std::at_quick_exit(on_exit);
  stack_t stack = {};
  stack.ss_sp = handler_stack.data();
  stack.ss_size = handler_stack.size();
  sigaltstack(&stack, nullptr);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
    struct sigaction present = {}, action = {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_DFL) continue;
    action.sa_handler = on_crash;
    action.sa_flags = SA_ONSTACK;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace trammel::tool
