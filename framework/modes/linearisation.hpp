// Small motions about a state, in independent coordinates y of the constraint manifold:
//
//     M_r y'' + D_r y' + K_r y = 0,     dq = Z y,   G Z = 0        Z: nv x m, tangent_space.hpp
//
// About a state of rest these are Z^T M Z, Z^T D Z and Z^T K Z with the system's D and K; K includes d(W^T lambda)/dq,
// the geometric stiffness of the constraints. About a state in motion Z moves along with it and its coefficients are
// frozen:
//
//     dv = Z y' + Y y,   Y = Z' + C Z      C: dv = (dq)' + C dq, omega x for turns in body axes, else 0
//     G Z' = -d(G v + g_t)/dq Z - G C Z    of least kinetic energy: Z^T M Z' = 0, Z turns only as much as the rows do
//     D_r = Z^T (M (Z' + Y) + D Z)
//     K_r = Z^T (M Y' + D Y + K Z),        Z^T M Z'' = -Z'^T M Z' - Z^T M' Z'
//
// Without these terms a pendulum that passes its lowest point would be too stiff by its rotation. The coefficients of a
// steady motion are constant and need no freezing: steady_linearisation.hpp. With sliding contacts W differs from G,
// and Z^T on the left is replaced by the null space of W.
#pragma once

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Of K and of rates that differences of forces and rows give: 27 times eps / difference_share.
inline constexpr double noise_of_differences = 1e-9;

struct Linearisation {
  Mat M, D, K;                          // m x m, of y
  Mat Z;                                // nv x m
  int redundant = 0;                    // rows
  double noise = noise_of_differences;  // noise_of_stiffness
  // [1/s] of a steady motion (constant coefficients): its largest velocity in its coordinate's size; else 0.
  double speed = 0;
  // [rad/s] of the frame in which y is measured, in the plane about the third axis; 0: the world.
  Eigen::Vector3d frame_rate = Eigen::Vector3d::Zero();
};

// `state` with the a and lambda of its equations of motion, and the system's contacts in its modes. Throws
// model::NotSolvable.
Linearisation linearise(model::AssembledSystem& system, const State& state);

// c_m M + c_d D + c_k K of all coordinates; the system is at the state.
Mat tangent(model::AssembledSystem& system, Blend blend, const State& state);

// Error of a stiffness that is exactly 0, relative to the terms that K is summed from: round-off, or differences where
// a component has no exact derivative.
double noise_of_stiffness(const model::Model& model);

// turned += C x; false: C is 0. `rates` are v, or v' for C'.
bool add_turning(const model::Model& model, const Vec& rates, const Mat& x, Mat& turned);

}  // namespace trammel::simulate
