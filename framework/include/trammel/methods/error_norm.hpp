// The norm in which a local error is measured: root mean square over q (as increments) and v of
//
//     e_q / (absolute + relative min(|q_i|, 2 h |v_i|))     e_v / (absolute + relative |v_i|)     the larger at the step's ends
//
// The size of a coordinate is the way that it goes in two steps, whatever its unit and place: a motion is as accurate 10^8 m from
// the origin as at it. A step that is many swings long goes further than the coordinate itself, which then counts. Where q has more
// numbers than increments (rotations), |q_i| is that of its largest entry. Beside all that, round-off of the largest entry of q, or
// of v, is no error of the method.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

// e_q, e_v: (nv) each. Not finite: infinity, so that the step is refused.
double error_norm(const Vec& e_q, const Vec& e_v, const State& now, const State& next, const Tolerance& tolerance);

}  // namespace trammel
