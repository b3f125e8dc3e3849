// The commands of this library, one function per file of the same name.
#pragma once

#include "arguments.hpp"

namespace trammel::tool {

Command static_command();
Command modes_command();
Command explain_command();
Command study_command();
Command trade_command();
Command compare_command();
Command check_command();
Command stability_command();

}  // namespace trammel::tool
