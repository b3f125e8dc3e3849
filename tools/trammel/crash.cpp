#include "crash.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "input.hpp"
#include "last_words.hpp"
#include "no_memory.hpp"
#include "plugin/breadcrumb.hpp"
#include "plugin/process/left_out.hpp"
#include "plugin/process/out_of_memory.hpp"

namespace trammel::tool {

namespace {

// True until the program ends normally (ends_by_itself). Global, because handlers have no other access.
std::atomic<bool> running = false;
pid_t this_process = 0;                   // not a child that rehearses a library
char* const* arguments = nullptr;         // of main
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

// Only plugins start threads, so a call that is in progress is not the cause.
bool on_another_thread() {
  return ::syscall(SYS_gettid) != ::getpid();
}

// Starts the program again without the library if it was loaded only because it lies in a searched folder. Returns if
// the library was named, or if the program cannot be started again: then the crash must be reported.
void leave_out(const simulate::CrashWitness::Culprit& who) {
  if (!who.origin || who.call != plugin::loading_with_its_folder() || ::getpid() != this_process) return;
  ::dup2(json_output(), STDOUT_FILENO);
  plugin::start_again_without(who.origin->file.c_str(), arguments);
}

// Reports which component ended the process and how, and ends it.
[[noreturn]] void report_and_end(std::string_view how) {
  const simulate::CrashWitness::Culprit who = witness().culprit();
  const bool by_thread = on_another_thread();
  if (!by_thread) leave_out(who);
  Line line;
  if (by_thread)
    line.add("a thread that a plugin started ended the program");
  else if (who.origin)
    line.add_culprit(who);
  else
    line.add("the program ended where no plugin is known to be called");
  line.add_time(who);
  line.add(": {}", how);
  end_process(who.origin || by_thread ? Exit::bad_plugin : Exit::failed, "failed", line);
}

void on_crash(int signal) {
  std::signal(signal, SIG_DFL);  // a second crash, in this handler, ends the process
  if (plugin::lacked_memory()) end_without_memory(std::bad_alloc());
  report_and_end(what_happened(signal));
}

void on_exit() {
  if (running && ::getpid() == this_process) report_and_end("it ended the program (exit), which no plugin may");
}

[[noreturn]] void on_terminate() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc& error) {
    end_without_memory(error);
  } catch (const std::exception& e) {
    Line how;
    how.add("it threw where no exception may leave: {}", e.what());
    report_and_end(how.text());
  } catch (...) {
  }
  report_and_end("it ended the program (std::terminate)");
}

}  // namespace

void ends_by_itself() {
  running = false;
}

void watch_for_crashes(char* const* words) {
  arguments = words;
  this_process = ::getpid();
  running = true;
  std::atexit(on_exit);
  std::at_quick_exit(on_exit);
  std::set_terminate(on_terminate);
  plugin::end_forks_of_calls();
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

// Replaces the C library's exit(): a plugin that calls it must not end a run as a success. The C library itself calls
// its own.
extern "C" [[noreturn, gnu::visibility("default")]] void _exit(int code) {
  trammel::tool::on_exit();
  trammel::tool::leave(code);
}
extern "C" [[noreturn, gnu::visibility("default")]] void _Exit(int code) {
  ::_exit(code);
}
