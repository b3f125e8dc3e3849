// Preloaded, it makes one allocation of a process fail, the TRAMMEL_TEST_ALLOCATION-th, and all later ones if
// TRAMMEL_TEST_FOR_GOOD is set. Child processes go on counting. glibc's own functions stand behind it.
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

std::atomic<long> count = 0;
long failing = 0;  // 0: not known yet; -1: none

bool fails() {
  if (failing == 0) {
    if (!environ) return false;  // the loader allocates before the C library has begun
    const char* number = std::getenv("TRAMMEL_TEST_ALLOCATION");
    failing = number ? std::atol(number) : -1;
  }
  const long this_one = ++count;
  if (failing < 0 || this_one < failing) return false;
  if (this_one > failing && !std::getenv("TRAMMEL_TEST_FOR_GOOD")) return false;
  errno = ENOMEM;
  return true;
}

}  // namespace

extern "C" {
void* malloc(std::size_t size) {
  return fails() ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(n, size);
}
void* realloc(void* block, std::size_t size) {
  return fails() ? nullptr : __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = fails() ? nullptr : __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}
}
