// The checks of bodies, joints, forces and contact laws of trammel/testing/components.hpp, with words of their own; and
// those of the kinds that the suites leave out.
#pragma once

#include "testing/kit/subject.hpp"

namespace trammel::kit {

Checks body_checks();
Checks joint_checks();
Checks force_checks();
Checks contact_force_checks();
Checks restitution_checks();

Checks refinable_checks();  // bodies that refine
Checks surface_checks();    // bodies with a surface
Checks smooth_friction_checks();
Checks set_valued_friction_checks();
Checks correction_checks();

}  // namespace trammel::kit
