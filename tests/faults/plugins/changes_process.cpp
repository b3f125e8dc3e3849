// A global's constructor changes the working folder and the access that new files get, and prints.
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

#include "idle.hpp"

namespace {
struct Meddling {
  Meddling() {
    ::umask(0777);
    std::printf("loaded\n");
    std::fflush(stdout);
    if (::chdir("/") != 0) std::perror("chdir");
  }
} meddling;
}  // namespace

TRAMMEL_PLUGIN(trammel::correction<Idle>("changes_process", "does nothing"))
