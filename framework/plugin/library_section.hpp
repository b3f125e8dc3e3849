// Reads a section of a shared library from its file, without loading it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace trammel::plugin {

// The pre-flight: a 64-bit ELF shared library of this machine, whole: every segment and section lies inside the file.
// (The loader maps what the headers promise; the missing pages of a truncated file would end the process with SIGBUS.)
// Returns the section's bytes, nothing if there is no such section. Throws PluginError naming file and cause.
std::optional<std::string> library_section(const std::filesystem::path& file, const std::string& name);

}  // namespace trammel::plugin
