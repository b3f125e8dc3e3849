// An operator new that reports the requested size when there is no memory; the program's libraries and plugins use it,
// too. If a large block is missing, there is room for small ones, and its exception is handled as usual. If a small one
// is missing, nothing can be allocated any more: the process ends with a prepared message.
#include <cstdlib>
#include <new>

#include "no_memory.hpp"
#include "plugin/process/out_of_memory.hpp"

// Sanitizers bring their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

void* operator new(std::size_t size) {
  constexpr std::size_t large = 1 << 20;  // bytes: much more than unwinding, a message and result.json take
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  if (size >= large) throw trammel::plugin::OutOfMemory(size);
  const trammel::plugin::OutOfMemory missing(size);
  // A child process that rehearses a library has another handler, which reports to its parent.
  if (const std::new_handler handler = std::get_new_handler()) trammel::tool::note_missing(missing), handler();
  trammel::tool::end_without_memory(missing);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

#endif
