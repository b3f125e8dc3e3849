// The steady motion nearest to a state that is nearly one: a precessing top whose rate was written with a few digits.
//
// The unknowns are q and v within the rows, and Omega. The accelerations must be those of the turning frame at the
// state and at two later times of the motion; otherwise a rotor that does not spin about its axis would be accepted.
//
//     M (E v - a) = 0 at tau = 0, tau_1, tau_2
//
// Gauss-Newton method with differences. There may be many solutions (a top has one for each tilt and spin); each step
// goes to the nearest.
#pragma once

#include <functional>
#include <optional>

#include "modes/turning_frame.hpp"

namespace trammel::simulate {

// Forces are measured against all forces, and against this share of the momentum times the largest velocity: gyroscopic
// forces may all vanish.
inline constexpr double share_of_momentum = 1e-4;

// Empty: the method does not converge, or the velocities of its result differ by 10 % or more.
std::optional<State> nearest_steady(model::AssembledSystem& system, const FlatTurning& flat, const State& state,
                                    const Eigen::Vector3d& rate);

// g = 0 and G v + g_t = 0 by the least change of q and v; `along`: dv/dq of this change. False: not possible.
bool onto_rows(model::AssembledSystem& system, State& s, std::function<Vec(const State&, const Vec&)> along);

}  // namespace trammel::simulate
