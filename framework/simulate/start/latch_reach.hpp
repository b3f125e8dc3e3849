// Latches that can never lock, by kinematics: from the start, the gap is made smaller along the rows,
//
//     [1 G^T] [dq]     [0]
//     [G  0 ] [mu] = - [b]       b = 0 in all rows but the latch's, which asks for a smaller gap;   then back onto the rows
//
// until it is 0, or stationary: no motion that the rows allow changes it. Stationary from the start and from states around it,
// each time above 0, it is an error that tells the smallest gap found. Forces and other contacts are not asked.
//
// Nothing is decided, and nothing said, where rows depend on time, for more than `most_rows` of them, and where the search does not
// end: the run then simply never locks.
#pragma once

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"
#include "scene/value.hpp"

namespace trammel::simulate {

// An error for each of them. `start` satisfies the rows; the system's modes are left open.
void check_latches(model::AssembledSystem& system, const State& start, double until, const scene::Value& root,
                   scene::Problems& problems);

}  // namespace trammel::simulate
