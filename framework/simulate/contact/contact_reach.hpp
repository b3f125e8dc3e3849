// Contacts whose gap no motion of the bodies changes: both markers on one rigid body, or on things without coordinates.
// The row of the gap in all velocities, joints left aside, is 0 there: at the start and wherever else the bodies are.
// And surfaces that start behind the plane they are to touch, all of them, as they do where its normal faces away.
#pragma once

#include <trammel/integrator.hpp>

#include "scene/value.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// An error for each of them.
void check_reach(model::AssembledSystem& system, const State& start, const scene::Value& root,
                 scene::Problems& problems);

}  // namespace trammel::simulate
