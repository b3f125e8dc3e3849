#include "interrupt.hpp"

#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "last_words.hpp"

namespace trammel::tool {

namespace {

constexpr unsigned patience = 5;       // [s] for a step to return
constexpr double same_request = 0.25;  // [s] `timeout` and a terminal that closes send their signal twice

// A signal handler has no other way to reach the run.
simulate::Interrupt interrupt;
double requested_at = 0;  // [s]
volatile std::sig_atomic_t first_signal = 0;

double now() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

[[noreturn]] void end_at_once(const char* why) {
  const simulate::CrashWitness::Culprit who = witness().culprit();
  Line line;
  line.add("interrupted");
  line.add_time(who);
  line.add(", before the step had returned, {}", why);
  if (who.origin) {
    line.add("; it was in ");
    line.add_culprit(who);
  }
  line.add(". What was recorded is kept, and --resume goes on from the last checkpoint, if there is one");
  end_process(Exit::interrupted, "interrupted", line);
}

// After the limit of CPU time SIGXCPU comes every second, so it does not force an end.
bool insists(int signal) {
  return (signal == SIGINT || signal == SIGTERM) && now() - requested_at > same_request;
}

void on_request(int signal) {
  const int error = errno;
  if (!interrupt.requested()) {
    requested_at = now();
    first_signal = signal;
    interrupt.request();
    ::alarm(patience);
  } else if (insists(signal)) {
    end_at_once("by a second signal");
  }
  errno = error;
}

void on_alarm(int) {
  if (!interrupt.heeded()) end_at_once("5 s after the signal");
}

}  // namespace

simulate::Interrupt& watch_for_interrupts() {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe of messages must not end the run
  struct sigaction action = {};
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGALRM}) sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction present = {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler == SIG_IGN) continue;
    action.sa_handler = on_request;
    sigaction(signal, &action, nullptr);
  }
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  return interrupt;
}

int interrupting_signal() {
  return first_signal;
}

}  // namespace trammel::tool
