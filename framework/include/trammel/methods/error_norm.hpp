// The norm of a local error: the root mean square over q (as increments) and v of
//
//     e_q / (absolute + relative min(|q_i|, 2 h |v_i|))     e_v / (absolute + relative |v_i|)
//
// with the larger value of the two ends of the step. The scale of a coordinate is its change in two steps, so that the
// accuracy does not depend on its unit or on the distance from the origin. For steps that are many oscillations long 2
// h |v_i| exceeds |q_i|, and |q_i| is the scale. If q has more numbers than increments (rotations), |q_i| is its
// largest entry. Round-off of the largest entry of q, or of v, does not count as an error of the method. Nor do the
// rates that rows derive from the round-off of q, if they exceed `absolute` (far from the origin).
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

// e_q, e_v: (nv) each. Returns infinity if they are not finite, so that the step is rejected.
double error_norm(const Vec& e_q, const Vec& e_v, const State& now, const State& next, const Tolerance& tolerance);

}  // namespace trammel
