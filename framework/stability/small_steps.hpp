// How a method satisfies the pendulum's row at ever smaller steps. Formulations that divide positions by h^2 (index 3)
// amplify the round-off of g: lambda then carries noise of about 1e-16/(beta h^2), and a fixed tolerance is never met.
// Formulations with velocity rows do not.
// Source of the estimate: Petzold, Lotstedt, SIAM J. Sci. Stat. Comput. 7 (1986) 720-733.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <trammel/testing/measurements.hpp>

namespace trammel::stability {

struct SmallStep {
  double h = 0;               // [s]
  double lambda_error = 0;    // largest of 10 steps, relative to the largest |lambda|
  double velocity_error = 0;  // likewise
  std::string rejected = "";  // the reason; then without errors
};
std::vector<SmallStep> small_steps(const Maker& method, std::span<const double> steps);

}  // namespace trammel::stability
