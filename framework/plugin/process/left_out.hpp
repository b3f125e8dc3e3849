// Libraries of a searched folder that passed their rehearsal but ended the process when they were loaded. The program
// starts again without them, so that one of them does not make the others of its folder unusable. An environment
// variable lists them for the new process, because nothing else survives a crash.
#pragma once

#include <string_view>

namespace trammel::plugin {

// The name of the call (breadcrumb.hpp) that loads a library only because it lies in a searched folder.
const char* loading_with_its_folder() noexcept;

bool is_left_out(std::string_view library);

// Starts the program again with the same arguments; returns if that is impossible. Safe in a signal handler.
void start_again_without(const char* library, char* const* arguments) noexcept;

}  // namespace trammel::plugin
