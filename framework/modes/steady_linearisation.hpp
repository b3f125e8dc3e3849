// Small motions about a steady motion, in one frame that turns with it (turning_frame.hpp):
//
//     dq = Z y,   Z' = B Z,   dv = Z y' + Y y,   Y = E Z,   dv' = Z y'' + (Z' + Y) y' + Y' y,   Y' = B Y
//
//     M_r = Z^T M Z,   D_r = Z^T (M (Z' + Y) + D Z),   K_r = Z^T (M Y' + D Y + K Z)
//
// with the system's D and K for the accelerations of the steady motion. The coefficients are constant if the system
// does not change as seen from the frame: a rotor with an axis of symmetry may spin in it, another may not. This is
// verified by comparing them with those at a later time of the motion. Frequencies are those seen from the frame.
#pragma once

#include <optional>

#include "modes/linearisation.hpp"
#include "modes/steady_motion.hpp"

namespace trammel::simulate {

// In the first of the motion's frames in which the coefficients are constant; empty: there is no such frame.
std::optional<Linearisation> linearise_steady(model::AssembledSystem& system, const SteadyMotion& motion);

// M_r, D_r and K_r; `s` with the a and lambda of the steady motion.
struct Coefficients {
  Mat M, D, K;
};
Coefficients coefficients_in(model::AssembledSystem& system, const TurningFrame& frame, const State& s, const Mat& Z,
                             const Mat& left);

}  // namespace trammel::simulate
