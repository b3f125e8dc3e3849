// One change of a scene that failed with which it gets past the place of the failure: tried, not guessed.
#pragma once

#include <optional>
#include <string>

#include <trammel/integrator.hpp>

#include "study/cases/batch.hpp"

namespace trammel::study {

struct Remedy {
  std::string what;     // "finer steps: hht_alpha with step 5e-05 s"
  Overrides overrides;  // as --set takes them
  double from = 0;      // [s] where the trial began
};

struct Failure {
  double t = 0;                    // [s]
  std::optional<State> last_good;  // simulate::RunReport; none: only the scene's start is known
};

// Runs on from the last good state, and if nothing helps there from the start, with finer steps, with rows projected,
// and with other methods in turn, until one of them passes the failure by a hundredth of the run. Each may take `limit`
// [s] of CPU time. Nothing: none did.
std::optional<Remedy> find_remedy(const SceneSource& source, plugin::Registry& registry, const Failure& failure,
                                  double limit);

}  // namespace trammel::study
