// The last line of a command's text names what its user does next:
//
//     next: trammel run scene.json --plugin build/my_method.so
#pragma once

#include <initializer_list>
#include <string_view>

#include "arguments.hpp"

namespace trammel::tool {

// `words` are those of a shell command; the user fills in NAME and SCENE. `carried` options are passed on as they were
// given. Prints nothing with --json or --quiet. The line is only advice: the command's findings are already printed, so
// it is left out if there is no memory.
void print_next(const Arguments& arguments, std::initializer_list<std::string_view> words,
                std::initializer_list<Option> carried = {}) noexcept;

}  // namespace trammel::tool
