// Refuses combinations of laws, corrections and bodies that cannot work in an analysis.
#pragma once

#include <trammel/correction.hpp>
#include "compatibility/neighbours.hpp"
#include "model/model.hpp"
#include "run/settings.hpp"
#include "scene/value.hpp"

namespace trammel::compatibility {

// Laws of contacts and of friction in joints.
void check_statics(const model::Model& model, const scene::Value& root, plugin::Registry& registry,
                   scene::Problems& problems);
void check_modes(const model::Model& model, const scene::Value& root, plugin::Registry& registry,
                 scene::Problems& problems);
// Contact laws that go with steps of a fixed length only.
void check_steps(const model::Model& model, const simulate::Settings& settings, const scene::Value& root,
                 scene::Problems& problems);

// A correction that needs the momentum of every body, with a body without HasMomentum.
void check_momentum(const Correction& correction, const scene::Value& value, const model::Model& model,
                    plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::compatibility
