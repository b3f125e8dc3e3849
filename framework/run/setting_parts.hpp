// The keys that the program itself reads of "integrator", "step", "simulate", "initial", "record" and "static":
// declared once, for their reading (settings.cpp), `trammel describe simulate` and the schema. Their defaults are those
// of Settings.
#pragma once

#include <vector>

#include "plugin/describe.hpp"

namespace trammel::simulate {

const std::vector<plugin::Part>& setting_parts();
const plugin::Part& setting_part(std::string_view name);  // the name must exist

}  // namespace trammel::simulate
