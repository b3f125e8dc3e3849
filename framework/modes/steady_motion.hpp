// A state of steady motion: it goes on as a whole seen from a frame that turns at a constant rate Omega, or from the
// world (0).
//
//     M a - f(t, q, v) + W^T lambda = 0,   g(t, q) = 0,   G v + g_t = 0,   a = E v
//
// E v are the accelerations of what turns with the frame (turning_frame.hpp): a rotor at its speed, a top in regular
// precession, a train on a straight line (a = 0), masses that go round. Omega follows from the state's own
// accelerations where they are of that kind; rotating bodies may also carry the frame. Where the state is not steady
// itself, one near it is sought: by Newton's method in q while velocities go along with what turns, v += E dq, and keep
// their spin; then in q, v and Omega (nearest_steady.hpp). That the motion lasts is looked at some way on.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <trammel/integrator.hpp>

#include "modes/turning_frame.hpp"

namespace trammel::simulate {

struct SteadyMotion {
  State state;                         // with a and lambda
  std::vector<Eigen::Vector3d> rates;  // Omega of frames it is steady in [rad/s], the slowest first
  double speed = 0;                    // [1/s] the largest velocity, in the size of its coordinate
  double tau() const;                  // [s] in which it goes some way: 0.7 of a size at its largest velocity
};

// The state as it is; no rates: it is not steady.
SteadyMotion steady_as_it_is(model::AssembledSystem& system, const State& state);

// From `state` on, in the system's modes. A text: there is none near, and why.
std::variant<SteadyMotion, std::string> find_steady_motion(model::AssembledSystem& system, const State& state);

// a and lambda of t, q, v for a motion that is steady in that frame.
State steady_state(model::AssembledSystem& system, const FlatTurning& flat, State at, const Eigen::Vector3d& rate);

}  // namespace trammel::simulate
