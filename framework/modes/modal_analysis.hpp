// `trammel modes`: the state that a scene is linearised at, its modes, and their files.
#pragma once

#include <optional>

#include "commands/simulation.hpp"

namespace trammel::simulate {

struct ModesOptions {
  std::filesystem::path
      out;         // modes.json, modes.csv, shapes.csv; made if missing. A run to the state has its own in run/
  int count = 10;  // of the lowest modes
  // The state: where the scene starts ("initial" says how); at a time, after a run to there, or under the loads of that
  // time for a scene of statics; of a checkpoint; or in steady motion, from the start on by Newton's method: v as it
  // is, v' = 0.
  std::optional<double> at;                   // [s]
  std::optional<std::filesystem::path> from;  // a results folder with a checkpoint
  bool steady = false;
  std::optional<std::filesystem::path> matrices;  // matrix_files.hpp
  std::vector<std::string> command;               // as in RunOptions
  Interrupt* interrupt = nullptr;
  CrashWitness* witness = nullptr;
};

// The scene must be loaded with simulate.until at `at`. Throws like run, and RunFailed or NotSolvable if no state or no
// modes are found.
RunReport analyse_modes(const scene::Scene& scene, plugin::Registry& registry, const ModesOptions& options);

}  // namespace trammel::simulate
