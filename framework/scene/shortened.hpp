// Quoted input, which may be very long and hold anything.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trammel::scene {

// The first bytes of the text, with "..." at the end if it was cut.
std::string shortened(std::string_view text, std::size_t longest = 80);
bool has_control_characters(std::string_view text, std::string_view other_than);
// Control characters other than the end of a line as JSON writes them, \u001b: a terminal does not obey them.
std::string printable(std::string_view text);

}  // namespace trammel::scene
