// The system's "Cannot allocate memory" as std::bad_alloc: a lack of memory is the fault of nobody whose file is being read.
#pragma once

#include <cerrno>
#include <new>

namespace trammel::scene {

inline void require_memory(int error) {
  if (error == ENOMEM) throw std::bad_alloc();
}

}  // namespace trammel::scene
