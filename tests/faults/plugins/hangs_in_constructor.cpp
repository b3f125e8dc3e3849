// Making the component never ends.
#include <unistd.h>

#include "idle.hpp"

namespace {
struct Hangs : Idle {
  Hangs() {
    for (;;) ::pause();
  }
  double weight = 1;
};
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Hangs>("hangs_in_constructor", "does nothing").parameter("weight", &Hangs::weight))
