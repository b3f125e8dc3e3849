// One change of a scene that failed with which it gets past the place of the failure: tried, not guessed.
#pragma once

#include <optional>
#include <string>

#include "study/batch.hpp"

namespace trammel::study {

struct Remedy {
  std::string what;     // "finer steps: hht_alpha with step 5e-05 s"
  Overrides overrides;  // as --set takes them
};

// Runs the scene again with finer steps, with rows projected, and with other methods in turn, until one of them passes
// `failed_at` [s] by a hundredth of the run. Each may take `limit` [s] of CPU time. Nothing: none did.
std::optional<Remedy> find_remedy(const SceneSource& source, plugin::Registry& registry, double failed_at,
                                  double limit);

}  // namespace trammel::study
