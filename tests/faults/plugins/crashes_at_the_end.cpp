// A global's destructor crashes.
#include <csignal>

#include "idle.hpp"

namespace {
struct Clumsy {
  ~Clumsy() { std::raise(SIGSEGV); }
} clumsy;
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("crashes_at_the_end", "does nothing"))
