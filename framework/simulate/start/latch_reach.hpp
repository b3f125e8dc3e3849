// Finds latches that can never lock, by kinematics. From the start, the gap is reduced along the rows,
//
//     [1 G^T] [dq]     [0]
//     [G  0 ] [mu] = - [b]       b = 0 except in the latch's row, which requires a smaller gap; then back onto the rows
//
// until it is 0 or stationary, which means that no motion that the rows allow changes it. If it is stationary above 0
// from the start and from states around it, an error names the smallest gap found. Forces and other contacts are
// ignored.
//
// There is no verdict and no message if rows depend on time, if there are more than `most_rows` of them, or if the
// search does not converge: the run then simply never locks.
#pragma once

#include <trammel/integrator.hpp>

#include "scene/value.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Reports an error for each of them. `start` satisfies the rows; the system's contacts are left open.
void check_latches(model::AssembledSystem& system, const State& start, double until, const scene::Value& root,
                   scene::Problems& problems);

}  // namespace trammel::simulate
