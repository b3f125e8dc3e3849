// Reading "friction" of a joint into the Model: a contact at its bearings.
#pragma once

#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::model {

// Of the joint that was added last, which `joint` describes.
void add_joint_friction(const scene::Value& joint, const scene::Value& friction, Model& model,
                        plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::model
