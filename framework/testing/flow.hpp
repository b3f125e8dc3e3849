// The exact solution from a point that lies on no closed form, such as where a method has got to.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

// Where the system's own motion leads from `now` in a time h, to round-off while h is at most half of its fastest
// motion's time: the modified midpoint rule with 2, 4, ..., 18 substeps, extrapolated in h^2 (Gragg; Hairer, Norsett,
// Wanner, Solving ODEs I, II.9), of order 18. Rows act by the accelerations that they ask for.
State exact_flow(System& s, const State& now, double h);

}  // namespace trammel
