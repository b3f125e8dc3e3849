// How fast the equations of motion swing and decay about a state: what bounds the steps of explicit methods.
//
//     along the rows   omega^2 the largest of |P M^-1 K x| / |x|,   1/tau that of |P M^-1 D x| / |x|      x with G x = 0
//     off the rows     c = |P M^-1 K x| / |x|                        x across the rows, of least kinetic energy
//
// |x|^2 = x M x, P the projection onto G x = 0 of least kinetic energy; K, D the tangents, K with that of the reactions. Largest ones
// by power iteration, so from below; without friction they are of a self-adjoint operator, and come near in some twenty products.
//
// c is no frequency. Off the rows by d, Baumgarte's form of the equations accelerates along them by c d: by lambda d / (m L) where a
// light body m holds a heavy one by a force lambda over a length L. Errors of the stages lie across the rows, so steps are of the
// order 1/sqrt(c), though no motion is that fast; on the rows (`rows: projected`) they are not.
#pragma once

#include <string>

#include "model/assembled_system.hpp"
#include "simulate/settings.hpp"

namespace trammel::simulate {

struct FastestMotion {
  double frequency = 0;  // omega [rad/s]
  double decay = 0;      // 1/tau [1/s]
  double off_rows = 0;   // sqrt(c) [1/s]; 0 without rows
  int body = -1;  // that moves most in what is fastest along the rows, by kinetic energy; -1: nothing swings or decays
  double rate() const { return std::max(frequency, decay); }
  // Whether Baumgarte's form takes steps much shorter than the motion does.
  bool held_by_light_bodies() const { return off_rows > 10 * rate(); }
};

// Leaves the system at the state, its projection's factors there. Nothing of it is finite where the equations have no solution.
FastestMotion fastest_motion(model::AssembledSystem& system, const State& state);

// "bodies.b swings at 1.4e+07 rad/s", "bodies.u of 1 kg holds bodies.l of 1e+12 kg, a mass ratio of 1e+12".
std::string told(const FastestMotion& fastest, const model::Model& model, const State& state);

}  // namespace trammel::simulate
