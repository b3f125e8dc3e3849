// Refuses an integrator that does not take what the scene needs, with the names of those that do.
#pragma once

#include <string>

#include "compatibility/need.hpp"
#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "run/settings.hpp"
#include "scene/value.hpp"
#include "system/assembled_system.hpp"

namespace trammel::compatibility {

struct ChosenIntegrator {
  const Integrator& method;
  const scene::Value& value;  // its object in the scene
  const std::string& type;
};

// Checks everything that is known without a state.
void check_integrator(const ChosenIntegrator& chosen, const model::Model& model, const simulate::Settings& settings,
                      plugin::Registry& registry, scene::Problems& problems);

// Checks rows that depend on each other at the start.
void check_redundant_rows(const ChosenIntegrator& chosen, model::AssembledSystem& system, const State& start,
                          plugin::Registry& registry, scene::Problems& problems);

}  // namespace trammel::compatibility
