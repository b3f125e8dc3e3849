// The integrator of a scene with finer steps.
#pragma once

#include <string>

#include "study/cases/batch.hpp"

namespace trammel::study {

struct FinerSteps {
  Overrides change;
  std::string what;  // "hht_alpha with step 5e-05 s"
  std::string type;  // of the integrator
  double share = 1;  // of the run's error that the difference to the finer run shows
};

// Fixed steps are halved, tolerances divided by ten; steps in contact likewise. Throws SceneError.
FinerSteps finer_steps(const SceneSource& source, plugin::Registry& registry);

}  // namespace trammel::study
