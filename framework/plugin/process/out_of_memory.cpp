#include "plugin/process/out_of_memory.hpp"

#include <atomic>

namespace trammel::plugin {

namespace {
std::atomic<bool> lacking = false;  // read by a signal handler
}

void note_lack_of_memory() noexcept {
  lacking = true;
}

bool lacked_memory() noexcept {
  return lacking;
}

}  // namespace trammel::plugin
