// What rows of joints and bodies may be off by before they count as violated: digits of a scene. Angles take the
// lengths' measure too where those are below 1 m.
//
//     1e-8 of the scene's length and speed, of 1 m, 1 rad, 1 m/s, 1 rad/s at most, beside the round-off of its place;
//     1e-6 of accelerations, which are quotients of differences
#pragma once

#include <algorithm>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct RowTolerance {
  static constexpr double of_acceleration = 1e-6;  // of the accelerations that rows ask for
  double length, speed;                            // [m], [m/s]
  double round_off;                                // [m] that an iteration may end with
  double acceleration;  // [m/s^2] of the rows, where no larger one is asked for: of the scene's length a second squared
  double missed_acceleration(double asked) const { return std::max(acceleration, of_acceleration * asked); }
};
RowTolerance row_tolerance(model::AssembledSystem& system, const State& s);  // leaves the system there

}  // namespace trammel::simulate
