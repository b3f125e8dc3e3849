// From a scene to a Model: space, gravity, bodies, joints, forces and contacts, each made by its plugin.
#pragma once

#include <memory>

#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::model {

// Everything a scene may hold at its top; unknown keys are errors.
//     "joints":   {"hinge": {"type": "revolute", "between": ["ground", "rod.end"], ...}}
//     "forces":   {"spring": {"type": "spring_damper", "between": [A, B], ...}, "push": {"type": "load", "on": "rod.tip", ...}}
//     "contacts": {"tip": {"type": "constraint_method", "between": [A, {"plane": {"point", "normal", "on": B}}]}}
// A contact may hold "friction": {"type": "coulomb", ...}. With "radius" A is the centre of a disk or sphere.
// A and B are markers, or fixed frames {"point": [x, y], "angle": a}. All problems are reported; the model returned then lacks
// what they are about. Throws PluginError when a plugin misbehaves.
std::shared_ptr<Model> build(const scene::Value& root, plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::model
