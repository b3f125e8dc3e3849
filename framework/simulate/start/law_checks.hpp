// Checks that laws of time are defined throughout the run, and that those whose derivatives enter the equations of
// motion (the length of a rod, the place of a base) are differentiable.
#pragma once

#include "plugin/parameters.hpp"
#include "scene/value.hpp"

namespace trammel::simulate {

// Reports tables that begin after the run does or end before it, and the first jump in the run of each law that a
// component of the scene differentiates.
void check_laws(const scene::Value& root, plugin::Registry& registry, double begin, double end,
                scene::Problems& problems);

}  // namespace trammel::simulate
