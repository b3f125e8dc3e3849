// Loads a library in a child process first. The child constructs its globals, calls its declarations and makes each
// component once, because the program itself could not catch a crash, a hang or an exit at that point.
#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>

namespace trammel::plugin {

// The C function that a library exports (trammel/plugin.hpp).
inline constexpr const char* entry_point = "trammel_declarations";

// Throws PluginError with file and cause if the child does not finish in time, or if the library leaves another process
// running; the child and its processes are then terminated. Exceptions of components are ignored here: they are
// reported when a scene uses the component.
void rehearse(const std::filesystem::path& file, std::chrono::milliseconds limit = std::chrono::seconds(10));

// True if the loader's message reports a lack of memory, which is not an error of the library. The loader has no error
// numbers.
bool tells_of_no_memory(std::string_view loader_message);

}  // namespace trammel::plugin
