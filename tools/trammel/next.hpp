// The last line of a command's text names what its user does next:
//
//     next: trammel run scene.json --plugin build/my_method.so
#pragma once

#include <initializer_list>
#include <string_view>

#include "arguments.hpp"

namespace trammel::tool {

// `words` of a shell; NAME and SCENE are for the user to fill in. `carried` options are passed on as they were given.
// Prints nothing with --json or --quiet. It is advice: what the command has found is printed by then, so for want of
// memory it is left out.
void print_next(const Arguments& arguments, std::initializer_list<std::string_view> words,
                std::initializer_list<Option> carried = {}) noexcept;

}  // namespace trammel::tool
