// A crash inside a plugin (a bad address, an illegal instruction, abort) ends the process with a message that names the
// component being called, time and step, and exit code 3; the records still in memory are written.
#pragma once

#include "simulate/crash_witness.hpp"

namespace trammel::tool {

// Installs the handlers, unless somebody watches already (a sanitizer), and returns what they ask. `json`: the message is a
// JSON object on standard output.
simulate::CrashWitness& watch_for_crashes(bool json);

}  // namespace trammel::tool
