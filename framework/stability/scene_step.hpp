// The largest fixed step with which a scene stays bounded, by bisection, compared with linear theory: the method's
// limit on the imaginary axis over the highest frequency of small motions about the start, or about the equilibrium if
// nothing swings there (diagnose/fastest_motion.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/cases/batch.hpp"

namespace trammel::stability {

struct LargestStep {
  double h = 0;                     // [s] bounded; 0: no step is
  bool at_limit = false;            // the longest step tried is bounded
  std::optional<double> predicted;  // [s] none: nothing swings, or the method has no limit
  std::string failure = "";         // why there is no reference for the energies
};

// A run is bounded if its kinetic and elastic energies never exceed ten times those of an accurate run.
// `integrator`: its JSON object without steps; `limit`: omega h at which the method ceases to be stable, if there is
// one.
LargestStep largest_step(const study::SceneSource& source, plugin::Registry& registry, const std::string& integrator,
                         std::optional<double> limit, const study::Overrides& change);

}  // namespace trammel::stability
