// From a scene to a Model: space, gravity, bodies, joints, forces and contacts, each made by its plugin.
#pragma once

#include <memory>

#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::model {

// All members of a scene's root; unknown keys are errors.
//     "joints":   {"hinge": {"type": "revolute", "between": ["ground", "rod.end"], ...}}
//     "forces":   {"spring": {"type": "spring_damper", "between": [A, B], ...}, "push": {"type": "load", "on": A, ...}}
//     "contacts": {"tip": {"type": "constraint_method", "between": [A, {"plane": {"point", "normal", "on": B}}]}}
// A contact may have "friction": {"type": "coulomb", ...}. With "radius", A is the centre of a disk or sphere.
// A and B are markers, or fixed frames {"point": [x, y], "angle": a}. All problems are reported; the returned model
// then lacks the entries with problems. Throws PluginError if a plugin fails.
std::shared_ptr<Model> build(const scene::Value& root, plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::model
