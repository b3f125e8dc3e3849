// What can be learnt from the file of a shared library, without loading it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace trammel::plugin {

// The pre-flight: a 64-bit ELF shared library of this machine, whole: every segment and section lies inside the file.
// (The loader maps what the headers promise; the missing pages of a truncated file would end the process with SIGBUS.)
// Returns the section's bytes, nothing if there is no such section. Throws PluginError naming file and cause.
std::optional<std::string> library_section(const std::filesystem::path& file, const std::string& name);
// Where it begins in the file [bytes].
std::optional<std::uint64_t> library_section_offset(const std::filesystem::path& file, const std::string& name);

// A checksum of what is loaded: code, constants, initial data, relocations and symbols, without the section `except`. strip changes
// none of it. Run-time search paths, which an installation writes anew, are no part of it.
std::uint64_t library_checksum(const std::filesystem::path& file, const std::string& except);

}  // namespace trammel::plugin
