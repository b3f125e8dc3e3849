// Checks, before anything else, that the processor has the instructions that this program was built for. On an older
// one the first unknown instruction would end the process without a message (SIGILL), perhaps in an initialiser of
// libtrammel. This file is compiled for the oldest x86-64, and the loader calls the functions of an executable's
// .preinit_array before the initialisers of all libraries. It uses nothing that could come from another file.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)

#include <sys/syscall.h>
#include <unistd.h>

namespace {

bool has(int present) {
  return present != 0;
}

// What -march=x86-64-v2 and -v3 add, as far as compilers use it without being asked.
bool processor_suffices() {
  constexpr int level = TRAMMEL_ARCH_LEVEL;
  __builtin_cpu_init();
  if (level >= 2 && !(has(__builtin_cpu_supports("ssse3")) && has(__builtin_cpu_supports("sse4.1")) &&
                      has(__builtin_cpu_supports("sse4.2")) && has(__builtin_cpu_supports("popcnt"))))
    return false;
  return level < 3 || (has(__builtin_cpu_supports("avx2")) && has(__builtin_cpu_supports("fma")) &&
                       has(__builtin_cpu_supports("bmi")) && has(__builtin_cpu_supports("bmi2")));
}

void require_processor(int, char**, char**) {
  if (processor_suffices()) return;
  constexpr char text[] =
      "trammel: this program was built for processors with the instructions of " TRAMMEL_ARCH_NAME
      " (AVX2 and FMA, since 2013), and this one lacks some of them; install the package for every x86-64, or build "
      "with -DTRAMMEL_ARCH=x86-64\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, sizeof text - 1);
  ::syscall(SYS_exit_group, 1);  // the program's own _exit is compiled for the newer processor
}

using Initialiser = void (*)(int, char**, char**);
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser before_all_libraries = require_processor;

}  // namespace

#endif
