// A global's constructor rounds all numbers of the process upwards, flushes denormals to 0, and asks for another
// locale.
#include <cfenv>
#include <clocale>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "idle.hpp"

namespace {
struct Careless {
  Careless() {
    std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
#endif
    std::setlocale(LC_ALL, "C.UTF-8");
  }
} careless;
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("changes_arithmetic", "does nothing"))
