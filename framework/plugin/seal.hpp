// The seal of a library: a checksum of its code in its .trammel section, written when it was built. A file that was
// damaged or modified afterwards is refused before any of its code is executed.
//
// TRAMMEL_PLUGIN reserves the space. A library without a seal, for example from a single compiler command, is accepted
// without this check. A seal detects accidents; it does not protect against forgery.
#pragma once

#include <filesystem>
#include <string_view>

namespace trammel::plugin {

// Throws PluginError if the library is not a plugin, has no space for a seal, or cannot be written.
void seal(const std::filesystem::path& library);

// `section`: its .trammel. Throws PluginError naming both checksums if they differ.
void require_seal(const std::filesystem::path& library, std::string_view section);

}  // namespace trammel::plugin
