// operator new that says how much was asked for when there is no memory; the program's libraries and plugins use it, too.
#include <cstdlib>
#include <new>

#include "plugin/out_of_memory.hpp"

namespace {

void* allocate(std::size_t size) {
  for (;;) {
    if (void* p = std::malloc(size > 0 ? size : 1)) return p;
    const std::new_handler make_room = std::get_new_handler();
    if (!make_room) throw trammel::plugin::OutOfMemory(size);
    make_room();
  }
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete[](void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  std::free(p);
}
