// The state at a part theta of a step, between two states of a solution: the cubic through v and a of both ends (Hermite), and
// the one through q and v, on the manifold of configurations. dq: scratch.
#pragma once

#include <trammel/integrator.hpp>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

inline void state_between(model::AssembledSystem& system, const State& now, const State& next, double theta, Vec& q,
                          Vec& v, Vec& dq) {
  const double h = next.t - now.t, x = theta, y = 1 - theta;
  const double end = x * x * (3 - 2 * x), begin_slope = h * x * y * y, end_slope = -h * x * x * y;
  system.difference(next.q, now.q, dq);
  dq = end * dq + begin_slope * now.v + end_slope * next.v;
  system.retract(now.q, dq, q);
  v = (1 - end) * now.v + end * next.v + begin_slope * now.a + end_slope * next.a;
}

}  // namespace trammel::simulate
