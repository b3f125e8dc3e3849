// Ctrl-C, SIGTERM, SIGHUP and SIGXCPU (the limit of CPU time) ask the run to stop after its current step. A step that
// does not return is ended by the second Ctrl-C or SIGTERM, or some seconds after the first signal; the records
// so far are kept in both cases.
#pragma once

#include "run/interrupt.hpp"

namespace trammel::tool {

// Installs the handlers, and returns what they request. Signals that are ignored (nohup, a shell's background) stay
// ignored.
simulate::Interrupt& watch_for_interrupts();
// The first of these signals that came; 0: none.
int interrupting_signal();

}  // namespace trammel::tool
