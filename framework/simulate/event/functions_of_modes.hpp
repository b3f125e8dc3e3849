// The event functions that the present modes have.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "simulate/event/event_function.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

std::vector<EventFunction> functions_of_modes(model::AssembledSystem& system, const ContactScale& scale);

}  // namespace trammel::simulate
