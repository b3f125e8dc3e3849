// Prepares input for messages that quote it: it may be very long and contain any character.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trammel::scene {

// The first bytes of the text, with "..." at the end if it was cut.
std::string shortened(std::string_view text, std::size_t longest = 80);
bool has_control_characters(std::string_view text, std::string_view other_than);
// The text with control characters, except ends of lines, written as in JSON (\u001b), so that a terminal does not obey
// them.
std::string printable(std::string_view text);

}  // namespace trammel::scene
