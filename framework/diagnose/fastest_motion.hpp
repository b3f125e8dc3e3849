// The highest frequency and decay rate of small motions about a configuration at rest, which bound the steps of
// explicit methods. At rest, because a fast spin is a motion to be resolved; it is neither stiff nor damped.
//
//     omega^2 the largest of |P M^-1 K x| / |x|,   1/tau that of |P M^-1 D x| / |x|      x with G x = 0
//
// |x|^2 = x M x, P the projection onto G x = 0 of least kinetic energy; K, D the tangents, K with that of the
// reactions. Power iteration gives lower bounds; without friction the operator is self-adjoint, and about twenty
// products suffice.
#pragma once

#include <algorithm>
#include <string>

#include "run/settings.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct FastestMotion {
  double frequency = 0;  // omega [rad/s]
  double decay = 0;      // 1/tau [1/s]
  int body = -1;         // with most of the kinetic energy of the fastest motion; -1: nothing swings or decays
  double rate() const { return std::max(frequency, decay); }
};

// Leaves the system and the factors of its projection at this state at rest. Throws model::NotSolvable.
FastestMotion fastest_motion(model::AssembledSystem& system, const State& state);

// "bodies.b swings at 1.4e+07 rad/s"
std::string description(const FastestMotion& fastest, const model::Model& model);

}  // namespace trammel::simulate
