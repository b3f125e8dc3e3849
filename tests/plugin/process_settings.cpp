#include "plugin/process/settings.hpp"

#include <gtest/gtest.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace trammel::plugin {
namespace {

TEST(ProcessSettings, NotesEveryOtherRounding) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ProcessSettings settings;
    EXPECT_STREQ(arithmetic_fault(), "");
    std::fesetround(mode);
    const std::string fault = arithmetic_fault();
    settings.put_back();
    EXPECT_EQ(fault, "numbers are no longer rounded to nearest") << mode;
    EXPECT_STREQ(arithmetic_fault(), "");
  }
}

#if defined(__SSE2__)
// Denormals flushed to 0 as results, or read as 0, which a library linked with -ffast-math does both.
TEST(ProcessSettings, NotesDenormalsThatBecomeZero) {
  for (const unsigned bits : {0x8000u, 0x0040u, 0x8040u}) {
    ProcessSettings settings;
    _mm_setcsr(_mm_getcsr() | bits);
    const std::string fault = arithmetic_fault();
    settings.put_back();
    EXPECT_EQ(fault, "numbers below 2.2e-308 (denormals) have become 0") << bits;
    EXPECT_STREQ(arithmetic_fault(), "");
  }
}
#endif

#if defined(__GLIBC__)
TEST(ProcessSettings, NotesTraps) {
  ProcessSettings settings;
  ::feenableexcept(FE_ALL_EXCEPT);
  const std::string fault = arithmetic_fault();
  settings.put_back();
  EXPECT_EQ(fault, "floating-point exceptions have become traps, which end the program");
  EXPECT_STREQ(arithmetic_fault(), "");
}
#endif

TEST(ProcessSettings, PutsBackAtItsEnd) {
  {
    const ProcessSettings settings;
    std::fesetround(FE_UPWARD);
  }
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

}  // namespace
}  // namespace trammel::plugin
