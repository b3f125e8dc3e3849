// Where and why a text is not JSON, in the words of someone who wants to repair it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trammel::scene {

struct SyntaxError {
  std::size_t at = 0;   // [bytes] from the start of the text: the comma too much, the place of the missing one, ...
  std::string message;  // what was found, what was expected, what to write instead
};

// The first fault of a JSON text with comments (// and /* */); nothing if it has none. Called for texts that the parser
// has refused: the parser decides what is valid, this says how to repair it.
std::optional<SyntaxError> find_syntax_error(std::string_view text);

}  // namespace trammel::scene
