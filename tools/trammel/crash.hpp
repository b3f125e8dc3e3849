// A crash inside a plugin (a bad address, an illegal instruction, abort), or a plugin that ends the program by exit(), ends the
// process with a message that names the component being called, time and step, and exit code 3; the records still in memory
// are written.
#pragma once

#include "simulate/crash_witness.hpp"

namespace trammel::tool {

// Installs the handlers, those of crashes unless somebody watches already (a sanitizer). `json`: the message is a JSON object on
// standard output.
void watch_for_crashes(bool json);
// The program ends as it should from here on: exit() is no longer a plugin's.
void ends_by_itself();

// What the handlers ask.
simulate::CrashWitness& witness();

}  // namespace trammel::tool
