// A global's constructor never ends and gives signs of life: it writes a byte to every file that may be open.
#include <unistd.h>

#include "idle.hpp"

namespace {
struct Talkative {
  Talkative() {
    for (;; ::usleep(20'000))
      for (int file = 3; file < 256; ++file) [[maybe_unused]] const ssize_t written = ::write(file, "x", 1);
  }
} talkative;
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("writes_for_ever", "does nothing"))
