// The motion of a marker A as an observer at marker B sees it: on a shaken table, in a vehicle.
//
//     x = R_B^T d,                 d = x_A - x_B
//     u = R_B^T (V_A - V_B - omega_B x d)
//     a = R_B^T (A_A - A_B - alpha_B x d - omega_B x (omega_B x d) - 2 omega_B x R_B u)
//
//     w = R_B^T (omega_A - omega_B),   R_B^T (alpha_A - alpha_B - omega_B x R_B w)
//
// and the difference of angles in the plane. Seen from the ground this is the motion in world axes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "simulate/results/observable.hpp"

namespace trammel::simulate {

// One number of a motion: x, vy, alpha, ...
struct MotionComponent {
  int order;      // 0 place, 1 velocity, 2 acceleration
  int component;  // as in a twist: linear, then angular
};

// The names that may follow a marker's: x y z vx vy vz ax ay az; of one with an orientation in the plane angle omega
// alpha too, in space omega_x ... alpha_z.
std::vector<std::pair<std::string, MotionComponent>> motion_components(Space space, bool orientation);
std::vector<std::pair<std::string, MotionComponent>> motion_components(const model::Model& model,
                                                                       model::MarkerRef marker);

double seen_from(Moment& moment, model::MarkerRef A, model::MarkerRef B, MotionComponent what);

}  // namespace trammel::simulate
