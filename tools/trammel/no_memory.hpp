// A lack of memory is not charged to a component, and no message can be built then: the process ends with a prepared
// message and exit code 1; the records so far are kept, and result.json says "failed".
#pragma once

#include <new>

#include "plugin/process/out_of_memory.hpp"

namespace trammel::tool {

// Sets the handler that operator new calls.
void watch_for_lack_of_memory();

void note_missing(const plugin::OutOfMemory& block) noexcept;  // the block that the handler will name

[[noreturn]] void end_without_memory(const std::bad_alloc& error);

}  // namespace trammel::tool
