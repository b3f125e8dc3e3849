#include "no_memory.hpp"

#include <cstdlib>
#include <exception>
#include <new>

#include "last_words.hpp"
#include "plugin/out_of_memory.hpp"

namespace trammel::tool {

namespace {

constexpr std::size_t large = 1 << 20;  // bytes: much more than unwinding, a message and result.json take

[[noreturn]] void missing(std::size_t size) {
  if (size >= large) throw plugin::OutOfMemory(size);
  end_without_memory();
}

}  // namespace

void watch_for_lack_of_memory() {
  std::set_new_handler(end_without_memory);  // for aligned blocks
}

void end_without_memory() {
  Line line;
  line.add("out of memory");
  line.add_time(witness().culprit());
  end_process(Exit::failed, "failed", line);
}

}  // namespace trammel::tool

// Sanitizers bring their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void* operator new(std::size_t size) {
  if (void* block = std::malloc(size ? size : 1)) return block;
  trammel::tool::missing(size);
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
#endif
