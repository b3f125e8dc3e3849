// Loads a library in a child process first: constructors of a library's globals run while it is loaded, and what they
// throw cannot be caught by the one who loads it; it ends the process, and so do a crash or exit() there.
#pragma once

#include <filesystem>

namespace trammel::plugin {

// Throws PluginError naming file and cause if the child did not survive, or did not finish within ten seconds.
void rehearse_loading(const std::filesystem::path& file);

}  // namespace trammel::plugin
