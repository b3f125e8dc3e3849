// Quoted input, which may be very long and hold anything.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trammel::scene {

// The first bytes of the text, with "..." at the end if it was cut.
std::string shortened(std::string_view text, std::size_t longest = 80);
// Control characters other than the end of a line as JSON writes them, \u0000: a message is not cut by them, and a
// terminal does not obey them.
std::string printable(std::string_view text);

}  // namespace trammel::scene
