// Which joints, and bodies with rows of their own, contradict each other.
//
// They do when no state near the given one satisfies them all: their positions, their velocities G v = -g_t, or their
// accelerations G a = gamma; velocities that the rows do not ask for are given up where those then can be met. The conflicting set
// named is a smallest one: without any of its members the rest can hold. Of more than 1000 rows it is looked for around the one that
// is missed most.
#pragma once

#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

// Paths of joints and bodies in the order of their rows; empty: all can hold, or none was found among so many.
std::vector<std::string> smallest_conflict(model::AssembledSystem& system, const State& start);
// What to say of them, if there are any.
std::string told(const std::vector<std::string>& conflict);

}  // namespace trammel::simulate
