// What must be equal in plugin and host before a C++ object crosses between them, as key=value lines (see
// trammel/plugin.hpp).
#pragma once

#include <string>
#include <string_view>

namespace trammel::plugin {

std::string_view host_fingerprint();

// Empty if a plugin with this fingerprint can be used here; else a sentence that names each difference with both
// values:
//     eigen_align: the plugin has 32, this program 16
// The SDK's major number must be the same and the plugin's minor number not newer than the host's.
std::string mismatch(std::string_view plugin, std::string_view host);

}  // namespace trammel::plugin
