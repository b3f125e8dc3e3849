// Contacts whose gap no motion of the bodies changes: both markers are on one rigid body, or on things without
// coordinates. There the gap's row in all velocities, without the joints, is 0 at the start and at other positions.
// Also finds surfaces that lie wholly behind their plane at the start, as if its normal faced the wrong way.
#pragma once

#include <trammel/integrator.hpp>

#include "scene/value.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Reports an error for each contact and each surface of these kinds.
void check_reach(model::AssembledSystem& system, const State& start, const scene::Value& root,
                 scene::Problems& problems);

}  // namespace trammel::simulate
