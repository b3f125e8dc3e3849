// The norm in which a local error is measured: root mean square over q (as increments) and v of
//
//     e_i / (absolute + relative max(|x_i| at the step's start, at its end))
//
// Where q has more numbers than increments (rotations), every increment takes the size of the largest entry of q.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

// e_q, e_v: (nv) each. Not finite: infinity, so that the step is refused.
double error_norm(const Vec& e_q, const Vec& e_v, const State& now, const State& next, const Tolerance& tolerance);

}  // namespace trammel
