#pragma once

#include <string>

#include "plugin/registry.hpp"

namespace trammel {

// The plugins of one folder, or of one library.
plugin::Registry& plugin_folder(const std::string& folder);

}  // namespace trammel
