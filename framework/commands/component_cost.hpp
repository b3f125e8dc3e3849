// The cost of each kind of component in one evaluation of the equations.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// [{"component": "rigid_body", "kind": "body", "count": 4, "microseconds": all four}, ...], the most expensive first.
// One component of each type is measured for a fraction of a millisecond at the state: mass and force of bodies, rows
// of joints, wrenches of forces, gap and gap rate of contacts with their markers. Empty if a component throws
// there.
nlohmann::ordered_json component_costs(model::AssembledSystem& system, const State& state);

}  // namespace trammel::simulate
