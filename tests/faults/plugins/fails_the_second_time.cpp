// A global's constructor crashes when the library is loaded once more: the file that the environment names says that it
// was before. HOW is what it does then.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "idle.hpp"

namespace {
struct Forgetful {
  Forgetful() {
    const char* const mark = std::getenv("TRAMMEL_TEST_FILE");
    if (!mark) return;
    if (::access(mark, F_OK) == 0) {
      ::unlink(mark);
      HOW;
    } else if (std::FILE* file = std::fopen(mark, "w")) {
      std::fclose(file);
    }
  }
} forgetful;
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("fails_the_second_time", "does nothing"))
