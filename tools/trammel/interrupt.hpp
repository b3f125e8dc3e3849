// Ctrl-C and SIGTERM ask the run to stop after its current step; a second one ends the process at once.
#pragma once

#include <atomic>

namespace trammel::tool {

// Installs the handlers and returns the flag that they set.
std::atomic<bool>& watch_for_interrupts();

}  // namespace trammel::tool
