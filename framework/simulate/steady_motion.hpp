// A state of steady motion: velocities stay, nothing accelerates.
//
//     f(t, q, v) = W^T lambda,   g(t, q) = 0,   G v + g_t = 0        v' = 0
//
// By Newton's method in q, v being corrected onto the rows after each step: a rotor at its speed with its parts stretched by
// it, a train on a straight line. Coordinates whose velocity turns with the body (a mass going round in world axes) have none.
#pragma once

#include <optional>
#include <string>

#include <trammel/integrator.hpp>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

// From `state` on, in the system's modes; a and lambda are set. A text: there is none near.
std::optional<std::string> find_steady_motion(model::AssembledSystem& system, State& state);

}  // namespace trammel::simulate
