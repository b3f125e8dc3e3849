// A scene made ready to run: model, integrator, corrections, settings and columns, with every problem of the scene reported.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <trammel/correction.hpp>
#include <trammel/integrator.hpp>

#include "model/model.hpp"
#include "plugin/plugin_error.hpp"
#include "simulate/observable.hpp"
#include "simulate/settings.hpp"
#include "simulate/simulation.hpp"

namespace trammel::simulate {

struct Setup {
  std::shared_ptr<model::Model> model;
  std::unique_ptr<Integrator> integrator;
  plugin::Origin integrator_origin;
  std::string integrator_type;
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
};

// Throws SceneError, PluginError. Statics needs no integrator, makes none and no corrections.
// The witness, if any, is told of the model while it is asked for its first state.
Setup set_up(const scene::Scene& scene, plugin::Registry& registry, Purpose purpose = Purpose::motion,
             CrashWitness* witness = nullptr);

}  // namespace trammel::simulate
