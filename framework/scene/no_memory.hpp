// Converts the system error "Cannot allocate memory" to std::bad_alloc: the file that is being read is not the cause.
#pragma once

#include <cerrno>
#include <new>

namespace trammel::scene {

inline void require_memory(int error) {
  if (error == ENOMEM) throw std::bad_alloc();
}

}  // namespace trammel::scene
