// Which joints, and bodies with rows of their own, contradict each other.
//
// They do when no state near the given one satisfies them all: their positions, their velocities G v = -g_t, or their
// accelerations G a = gamma. Velocities that the rows do not require are set to 0 if the accelerations can be met then.
// The set of joints named is a smallest one: without any of its members the others can be satisfied. With more than
// 1000 rows it is sought around the row with the largest residual; if it is not among 1000 rows there, that row alone
// is named.
#pragma once

#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct Conflict {
  std::vector<std::string> paths;  // of joints and bodies in the order of their rows; empty: there is no conflict
  bool smallest = true;            // false: with some neighbours, or only the row with the largest residual
  bool empty() const { return paths.empty(); }
};
Conflict smallest_conflict(model::AssembledSystem& system, const State& start);
// The message about a conflict: "joints.a, joints.b prescribe motions that contradict each other; without ...", and its
// parts.
std::string description(const Conflict& conflict);
std::string names(const Conflict& conflict);   // if there are many, the first and last ones
std::string remark(const Conflict& conflict);  // "; without any one of them the rest can hold"

}  // namespace trammel::simulate
