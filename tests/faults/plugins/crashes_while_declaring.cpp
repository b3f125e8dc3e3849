// The function that returns the declarations reads from address 0.
#include "idle.hpp"

namespace {
const char* name() {
  const char* const volatile* const volatile nowhere = nullptr;
  return *nowhere;
}
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>(name(), "does nothing"))
