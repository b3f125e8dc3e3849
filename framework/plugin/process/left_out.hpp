// Libraries of a folder that ended the process when they were loaded, though not when they were tried out. The process
// starts again without them: one of them does not make the others of its folder unusable. An environment variable tells
// the new one, because nothing else survives a crash.
#pragma once

#include <string_view>

namespace trammel::plugin {

// The name of the call (breadcrumb.hpp) while a library is loaded that nobody has named.
const char* loading_with_its_folder() noexcept;

bool is_left_out(std::string_view library);

// Starts the program again with the same arguments; returns if that is impossible. For a handler of signals.
void start_again_without(const char* library, char* const* arguments) noexcept;

}  // namespace trammel::plugin
