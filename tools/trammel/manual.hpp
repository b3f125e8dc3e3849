// The manual page and the shell completion of an installation, from the declarations of the commands.
#pragma once

#include <string>
#include <vector>

#include "arguments.hpp"

namespace trammel::tool {

std::string manual_page(const std::vector<Command>& commands);      // troff, for man(1)
std::string bash_completion(const std::vector<Command>& commands);  // needs the package bash-completion

}  // namespace trammel::tool
