// A crash inside a plugin (a bad address, an illegal instruction, abort), or a plugin that ends the program by exit()
// or _exit(), ends the process with a message that names the component being called, time and step, and exit code 3;
// the records still in memory are written.
#pragma once

namespace trammel::tool {

// Installs the handlers; a crash signal that already has a handler, such as a sanitizer's, keeps it. `words` are
// main's: the program starts again without a library that crashes and was not named (plugin/process/left_out.hpp).
void watch_for_crashes(char* const* words);
// To be called before the program ends normally: exit() is no longer charged to a plugin.
void ends_by_itself();

}  // namespace trammel::tool
