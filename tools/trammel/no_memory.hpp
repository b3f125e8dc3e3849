// A lack of memory is nobody's fault and leaves nothing to build a message from: where a small block cannot be had, the process ends
// with one that stands ready, exit code 1, and the records so far; result.json says "failed".
//
// A large block that is missing leaves room for small ones: std::bad_alloc takes the usual way, to whoever knows what it was for. Its
// what() says how much was asked for.
#pragma once

namespace trammel::tool {

// What is asked for by other ways than operator new is watched from here on, too.
void watch_for_lack_of_memory();

[[noreturn]] void end_without_memory();

}  // namespace trammel::tool
