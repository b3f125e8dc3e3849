// The seal of a library: a checksum of its code in its own .trammel section, written when it was built. A file that was damaged
// since, or cut and pasted together, is refused before any of it runs.
//
// TRAMMEL_PLUGIN leaves room for it; a library that was never sealed, one from a single line of a compiler for instance, has none
// and is taken as it is. A seal tells of accidents; it is no protection against forgery.
#pragma once

#include <filesystem>
#include <string_view>

namespace trammel::plugin {

// Throws PluginError if the library is no plugin, has no room for a seal, or cannot be written.
void seal(const std::filesystem::path& library);

// `section`: its .trammel. Throws PluginError naming both checksums if they differ.
void require_seal(const std::filesystem::path& library, std::string_view section);

}  // namespace trammel::plugin
