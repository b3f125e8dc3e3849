// Quoting what was found, which a machine may have written without end.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trammel::scene {

// At most so many bytes of it; "..." at the end says that there is more.
std::string shortened(std::string_view text, std::size_t longest = 80);

}  // namespace trammel::scene
