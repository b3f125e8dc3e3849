// Quoting what was found, which a machine may have written without end.
#pragma once

#include <string>
#include <string_view>

namespace trammel::scene {

// At most 80 bytes of it; "..." at the end says that there is more.
std::string shortened(std::string_view text);

}  // namespace trammel::scene
