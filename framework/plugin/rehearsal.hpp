// Loads a library in a child process first: constructors of a library's globals run while it is loaded, and what they
// throw cannot be caught by the one who loads it; it ends the process, and so do a crash or exit() there.
#pragma once

#include <chrono>
#include <filesystem>

namespace trammel::plugin {

// Throws PluginError naming file and cause if the child did not survive, or did not finish in time.
void rehearse_loading(const std::filesystem::path& file, std::chrono::milliseconds limit = std::chrono::seconds(10));

}  // namespace trammel::plugin
