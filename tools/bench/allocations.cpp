#include "allocations.hpp"

#include <cstdlib>

namespace {
thread_local long long count = 0;
}

// operator new and Eigen end here, in the plugins too.
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}

namespace trammel::bench {

long long allocations() {
  return count;
}

}  // namespace trammel::bench
