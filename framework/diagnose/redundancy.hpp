// Which joints, and bodies with rows of their own, have redundant rows.
//
// Rows are independent as long as each has a part perpendicular to all rows before it; a row without one is redundant.
#pragma once

#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "linear/saddle_point.hpp"
#include "scene/value.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

constexpr double rank_tolerance = numerics::least_rank_tolerance;  // sine of a row's angle to those before it

struct RedundantRows {
  std::string path;       // in the scene: "joints.hinge", "bodies.rod"
  std::vector<int> rows;  // its redundant rows, counted from 0
  int of = 0;             // number of its rows
};
// In the scene's order, at the state, whose positions should satisfy the rows.
std::vector<RedundantRows> redundant_rows(model::AssembledSystem& system, const State& state);
// "joints.hinge: rows 4, 5 of 5 follow from the rows before".
std::string description(const RedundantRows& rows);
// Warns about joints with friction whose reactions are not unique, and so their friction.
void check_bearing_loads(model::AssembledSystem& system, const State& state, const scene::Value& root,
                         scene::Problems& problems);

}  // namespace trammel::simulate
