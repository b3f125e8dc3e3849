// Which joints, and bodies with rows of their own, say the same twice, and which contradict each other.
//
// Rows are independent as long as each has a part perpendicular to all rows before it; a row without one is redundant.
// They conflict when no state near the given one satisfies them all: their positions, their velocities G v = -g_t, or their
// accelerations G a = gamma; velocities that the rows do not ask for are given up where those then can be met. The conflicting set
// named is a smallest one: without any of its members the rest can hold.
#pragma once

#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

struct RedundantRows {
  std::string path;  // in the scene: "joints.hinge", "bodies.rod"
  int redundant = 0, of = 0;
};
// In the scene's order, at the state; its positions should hold.
std::vector<RedundantRows> redundant_rows(model::AssembledSystem& system, const State& state);

// Paths of joints and bodies in the order of their rows; empty: all can hold, or there are too many to search.
std::vector<std::string> smallest_conflict(model::AssembledSystem& system, const State& start);
// What to say of them, if there are any.
std::string told(const std::vector<std::string>& conflict);

}  // namespace trammel::simulate
