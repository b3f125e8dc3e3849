// A crash inside a plugin (a bad address, an illegal instruction, abort), or a plugin that ends the program by exit()
// or _exit(), ends the process with a message that names the component being called, time and step, and exit code 3;
// the records still in memory are written.
#pragma once

namespace trammel::tool {

// Installs the handlers, those of crashes unless somebody watches already (a sanitizer). `words` are main's: the
// program starts again without a library that crashes and that nobody has named (plugin/process/left_out.hpp).
void watch_for_crashes(char* const* words);
// From here on the program ends normally: exit() is no longer charged to a plugin.
void ends_by_itself();

}  // namespace trammel::tool
