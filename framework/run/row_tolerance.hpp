// The violation at which rows of joints and bodies count as violated: the accuracy of a scene's digits. In scenes
// smaller than 1 m the measure of lengths also applies to angles.
//
//     1e-8 of the scene's length and speed, at most of 1 m, 1 rad, 1 m/s, 1 rad/s, plus the round-off of its place;
//     1e-6 of accelerations, which are quotients of differences
#pragma once

#include <algorithm>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct RowTolerance {
  static constexpr double of_acceleration = 1e-6;  // relative to the accelerations that rows require
  double length, speed;                            // [m], [m/s]
  double round_off;                                // [m] with which an iteration may end
  double acceleration;  // [m/s^2] if rows require no larger one: the scene's length per second squared
  double missed_acceleration(double asked) const { return std::max(acceleration, of_acceleration * asked); }
};
RowTolerance row_tolerance(model::AssembledSystem& system, const State& s);  // leaves the system there

}  // namespace trammel::simulate
