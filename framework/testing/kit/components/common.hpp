// Checks of every component, whatever its kind: its declaration, its parameters, and what it does to the process.
#pragma once

#include "testing/kit/subject.hpp"

namespace trammel::kit {

Checks parameter_checks();
Checks process_checks();

}  // namespace trammel::kit
