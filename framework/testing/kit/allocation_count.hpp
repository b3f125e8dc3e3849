// Counts the memory that a loaded library and libtrammel ask for, by the functions that their relocations name: what
// the harness and the program allocate is not charged to the plugin.
#pragma once

#include <string>

namespace trammel::kit {

// From now on the library's calls of malloc, calloc, realloc, aligned_alloc, posix_memalign and operator new are
// counted. False where that is not possible (another processor than x86-64).
bool count_allocations_of(const std::string& library);
long long allocations();  // so far

}  // namespace trammel::kit
