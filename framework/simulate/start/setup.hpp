// A scene made ready to run: model, integrator, corrections, settings and columns, with every problem of the scene
// reported.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <trammel/correction.hpp>
#include <trammel/integrator.hpp>

#include "model/model.hpp"
#include "plugin/identity.hpp"
#include "plugin/plugin_error.hpp"
#include "plugin/registry.hpp"
#include "run/settings.hpp"
#include "simulate/results/observable.hpp"

namespace trammel::simulate {

class CrashWitness;

struct Setup {
  std::shared_ptr<model::Model> model;
  std::unique_ptr<Integrator> integrator;
  plugin::Origin integrator_origin;
  std::string integrator_type;
  std::string chosen;  // name of the integrator that Trammel chose (integrator_choice.hpp); empty: the scene names one
  std::string choice;  // the choice in full, with its reason
  struct LevelCorrection {
    Correction::Level level;
    std::unique_ptr<Correction> correction;
    plugin::Origin origin;
  };
  std::vector<LevelCorrection> corrections;  // in the order they are applied
  Settings settings;
  std::vector<Column> columns;
  State initial;
  std::vector<std::string> warnings;
  std::vector<plugin::Identity> plugins;  // loaded for this scene, with their files at that time
};

// Throws SceneError, PluginError. Statics needs no integrator and makes no integrator and no corrections. The witness,
// if any, follows the model while it is asked for its initial state. `chosen_before` is Setup::chosen of the run that
// is resumed.
Setup set_up(const scene::Scene& scene, plugin::Registry& registry, Purpose purpose = Purpose::motion,
             CrashWitness* witness = nullptr, const std::string& chosen_before = "");

}  // namespace trammel::simulate
