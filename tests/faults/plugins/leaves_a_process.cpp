// A global's constructor starts a process that outlives this one. Its number goes to the file that the environment
// names.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "idle.hpp"

namespace {
struct Forks {
  Forks() {
    const pid_t process = ::fork();
    if (process == 0) {
      ::sleep(60);
      ::_exit(0);
    }
    if (const char* name = std::getenv("TRAMMEL_TEST_FILE"))
      if (std::FILE* file = std::fopen(name, "w")) {
        std::fprintf(file, "%d\n", int(process));
        std::fclose(file);
      }
  }
} forks;
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("leaves_a_process", "does nothing"))
