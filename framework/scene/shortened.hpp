// Shortens quoted input, which may be very long.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trammel::scene {

// The first bytes of the text, with "..." at the end if it was cut.
std::string shortened(std::string_view text, std::size_t longest = 80);

}  // namespace trammel::scene
