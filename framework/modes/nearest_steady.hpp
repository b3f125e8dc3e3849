// The steady motion nearest to a state that is not quite one: a top in precession whose rate was written with a few
// digits.
//
// The unknowns are q and v within the rows, and Omega. The accelerations must be those of the turning frame at the
// state and at two later times of the motion; otherwise a rotor that does not spin about its axis would be accepted.
//
//     M (E v - a) = 0 at tau = 0, tau_1, tau_2
//
// Gauss-Newton method with differences. There may be many solutions (a top has one for each tilt and spin); each step
// goes to the nearest.
#pragma once

#include <algorithm>
#include <optional>

#include "modes/turning_frame.hpp"

namespace trammel::simulate {

// None: the method does not converge, or the velocities of its result differ by 10 % or more.
std::optional<State> nearest_steady(model::AssembledSystem& system, const FlatTurning& flat, const State& state,
                                    const Eigen::Vector3d& rate);

// g = 0 and G v + g_t = 0 by the least change of q and v; `along`: dv/dq of this change. False: not possible.
template <class Along>
bool onto_rows(model::AssembledSystem& system, State& s, Along&& along) {
  const Sizes n = system.sizes();
  if (n.nc == 0) return true;
  const Vec zero = Vec::Zero(n.nv), no_force = Vec::Zero(n.nc);
  Vec dq, dv, unused, q;
  for (int i = 0; i < 5; ++i) {
    system.move_to(s.t, s.q, s.v);
    const Vec g = system.g();
    if (g.lpNorm<Eigen::Infinity>() <= 1e-15 * std::max(1.0, s.q.lpNorm<Eigen::Infinity>())) break;
    system.factorise({1, 0, 0}, zero, no_force, Factors::projection);
    if (!system.correct(zero, g, dq, unused, Factors::projection)) return false;
    s.v += along(s, dq);
    system.retract(s.q, dq, q);
    s.q = q;
  }
  system.move_to(s.t, s.q, s.v);
  system.factorise({1, 0, 0}, zero, no_force, Factors::projection);
  if (!system.correct(zero, Vec(system.g_dot()), dv, unused, Factors::projection)) return false;
  s.v += dv;
  return true;
}

}  // namespace trammel::simulate
