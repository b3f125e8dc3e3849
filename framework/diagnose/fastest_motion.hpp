// How fast the equations of motion swing and decay about a configuration at rest: what bounds the steps of explicit methods. At rest,
// because a fast spin is a motion to be followed, and neither stiff nor damped.
//
//     omega^2 the largest of |P M^-1 K x| / |x|,   1/tau that of |P M^-1 D x| / |x|      x with G x = 0
//
// |x|^2 = x M x, P the projection onto G x = 0 of least kinetic energy; K, D the tangents, K with that of the reactions. Largest ones
// by power iteration, so from below; without friction they are of a self-adjoint operator, and come near in some twenty products.
#pragma once

#include <algorithm>
#include <string>

#include "system/assembled_system.hpp"
#include "run/settings.hpp"

namespace trammel::simulate {

struct FastestMotion {
  double frequency = 0;  // omega [rad/s]
  double decay = 0;      // 1/tau [1/s]
  int body = -1;         // that moves most in what is fastest, by kinetic energy; -1: nothing swings or decays
  double rate() const { return std::max(frequency, decay); }
};

// Leaves the system at rest there, its projection's factors there. Throws model::NotSolvable.
FastestMotion fastest_motion(model::AssembledSystem& system, const State& state);

// "bodies.b swings at 1.4e+07 rad/s"
std::string description(const FastestMotion& fastest, const model::Model& model);

}  // namespace trammel::simulate
