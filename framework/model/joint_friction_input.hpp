// Reading "friction" of a joint into the Model: a contact at its bearings.
#pragma once

#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::model {

// Adds the friction of the joint that was added last; `joint` is its object in the scene.
void add_joint_friction(const scene::Value& joint, const scene::Value& friction, Model& model,
                        plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::model
