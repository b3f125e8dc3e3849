// The properties that must be equal in plugin and host before they may exchange C++ objects, as key=value lines
// (trammel/plugin.hpp).
#pragma once

#include <string>
#include <string_view>

namespace trammel::plugin {

std::string_view host_fingerprint();

// Returns "" if a plugin with this fingerprint can be used, else a text that names each difference with both values:
//     eigen_align: the plugin has 32, this program 16
// The SDK's major numbers must be equal, and the plugin's minor number must not be newer than the host's.
std::string mismatch(std::string_view plugin, std::string_view host);

}  // namespace trammel::plugin
