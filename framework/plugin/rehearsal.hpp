// Loads a library in a child process first. Its globals are constructed there, its components declared, and each of them made once:
// what crashes, hangs or ends the process on the way cannot be caught by the one who loads it.
#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>

namespace trammel::plugin {

// The C function that a library exports (trammel/plugin.hpp).
inline constexpr const char* entry_point = "trammel_declarations";

// Throws PluginError naming file and cause if the child did not come through in time, from its start to its end, or if the library
// leaves another process behind. The child and all that it started are ended then. What components throw is left to those who
// make them.
void rehearse(const std::filesystem::path& file, std::chrono::milliseconds limit = std::chrono::seconds(10));

// The loader has no error numbers: whether its message says that memory was lacking, which is not the library's fault.
bool tells_of_no_memory(std::string_view loader_message);

}  // namespace trammel::plugin
