// Finds where and why a text is not JSON and how to repair it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trammel::scene {

struct SyntaxError {
  std::size_t at = 0;   // [bytes] from the start: an extra comma, the place of a missing one, ...
  std::string message;  // what was found, what was expected, what to write instead
};

// The first error in a JSON text with comments (// and /* */); empty if there is none. It is called for texts that the
// parser has refused: the parser decides what is valid, this function explains the error.
std::optional<SyntaxError> find_syntax_error(std::string_view text);

}  // namespace trammel::scene
