// The exact solution from any point, such as one that a method has reached.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

// The state at a time h after `now` by the system's own motion, to round-off if h is at most half the time scale of its
// fastest motion: the modified midpoint rule with 2, 4, ..., 18 substeps, extrapolated in h^2 to order 18 (Gragg;
// Hairer, Norsett, Wanner, Solving ODEs I, II.9). Rows act by the accelerations that they require.
State exact_flow(System& s, const State& now, double h);

}  // namespace trammel
