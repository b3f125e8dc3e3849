// The function that returns the declarations waits for something that never comes.
#include <unistd.h>

#include "idle.hpp"

namespace {
const char* name() {
  for (;;) ::pause();
}
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>(name(), "does nothing"))
