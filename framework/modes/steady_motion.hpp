// A state of steady motion: seen from a frame that rotates at a constant rate Omega, or from the world (Omega = 0), it
// goes on unchanged as a whole.
//
//     M a - f(t, q, v) + W^T lambda = 0,   g(t, q) = 0,   G v + g_t = 0,   a = E v
//
// E v are the accelerations of a motion that rotates with the frame (turning_frame.hpp): a rotor at its speed, a top in
// regular precession, a train on a straight line (a = 0), masses on a circle. Omega follows from the state's own
// accelerations if they are of that kind; the frame may also rotate with one of the bodies. If the state is not steady,
// a steady one is sought near it by Newton's method: first in q, while velocities follow the rotation, v += E dq, and
// keep their spin; then in q, v and Omega (nearest_steady.hpp). The motion is verified at a later time.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <trammel/integrator.hpp>

#include "modes/turning_frame.hpp"

namespace trammel::simulate {

struct SteadyMotion {
  State state;                         // with a and lambda
  std::vector<Eigen::Vector3d> rates;  // [rad/s] Omega of the frames in which it is steady, the slowest first
  double speed = 0;                    // [1/s] the largest velocity relative to the size of its coordinate
  double tau() const;                  // [s] time in which the fastest coordinate moves by 0.7 of its size
};

// The state itself; without rates: it is not steady.
SteadyMotion steady_as_it_is(model::AssembledSystem& system, const State& state);

// The search starts from `state`, in the system's modes. The text states why there is none nearby.
std::variant<SteadyMotion, std::string> find_steady_motion(model::AssembledSystem& system, const State& state);

// t, q and v of `at` with a and lambda of a motion that is steady in that frame.
State steady_state(model::AssembledSystem& system, const FlatTurning& flat, State at, const Eigen::Vector3d& rate);

}  // namespace trammel::simulate
