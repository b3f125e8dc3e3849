// Reads sections of a shared library's file without loading the library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace trammel::plugin {

// The check before loading: the file must be a 64-bit ELF shared library for this machine, with all segments and
// sections inside the file. (The loader maps what the headers state; missing pages of a truncated file would end the
// process with SIGBUS.) Returns the section's bytes, or nothing if there is no such section. Throws PluginError with
// file and cause.
std::optional<std::string> library_section(const std::filesystem::path& file, const std::string& name);
// Offset of the section in the file [bytes].
std::optional<std::uint64_t> library_section_offset(const std::filesystem::path& file, const std::string& name);

// A checksum of the loaded contents: code, constants, initial data, relocations and symbols, without the section
// `except`. strip does not change it. Run-time search paths, which an installation rewrites, are not included.
std::uint64_t library_checksum(const std::filesystem::path& file, const std::string& except);

}  // namespace trammel::plugin
