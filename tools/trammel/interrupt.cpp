#include "interrupt.hpp"

#include <csignal>

namespace trammel::tool {

namespace {

// A signal handler has no other way to reach the run; a lock-free atomic is what it may touch.
std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int) {
  stop_requested = true;
}

}  // namespace

std::atomic<bool>& watch_for_interrupts() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  // Back to the default after the first signal: the second one ends the process.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop_requested;
}

}  // namespace trammel::tool
