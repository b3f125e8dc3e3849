// A lack of memory is nobody's fault and leaves nothing to build a message from: the process ends with one that stands ready, exit
// code 1, and the records so far; result.json says "failed".
#pragma once

#include <cstddef>
#include <new>

namespace trammel::tool {

// What is asked for by other ways than operator new (allocation.cpp) is watched from here on, too.
void watch_for_lack_of_memory();

[[noreturn]] void end_without_memory(std::size_t asked_for);  // [bytes]
[[noreturn]] void end_without_memory(const std::bad_alloc& error);

}  // namespace trammel::tool
