// Coordinates of a configuration that is fixed in a frame that rotates at a constant rate Omega.
//
// Some coordinates are places in the world's axes, some are rotations in a body's own axes, some are neither (angles of
// hinges, amplitudes of modes). An increment x of the configuration that is fixed in the frame has
//
//     x' = B x          places: Omega x x;   turns in body axes: (R^T Omega - omega) x x;   others: 0
//
// and the velocities of a neighbouring motion differ by dv = (dq)' + C dq with C = omega x of turns. So dv = E x with E
// = B + C, which is Omega x of places and R^T Omega x of turns. A motion that is steady in the frame has the
// accelerations E v.
#pragma once

#include <array>
#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// x' of a body's flat coordinates for 1 rad/s about each of the world's axes; empty: they do not rotate.
using FlatTurning = std::vector<std::array<Mat, 3>>;
// Derived from the bodies' momentum, which gives their velocities in a rotation of the world. Bodies without
// HasMomentum are treated as coordinates that do not rotate. Exact for coordinates that are places.
FlatTurning flat_turning(model::AssembledSystem& system, double t, const Vec& q);

class TurningFrame {
 public:
  // `rate` is Omega [rad/s], in the plane about the third axis. `at` gives t, q, v.
  TurningFrame(const model::Model& model, const FlatTurning& flat, const State& at, const Eigen::Vector3d& rate);

  Mat carried(const Mat& x) const;  // B x
  Mat turned(const Mat& x) const;   // E x
  // A vector that is fixed in the frame, and the steady motion itself, `tau` [s] later.
  Mat after(double tau, const Mat& x) const;
  State after(double tau) const;  // t, q, v

 private:
  struct Part {
    bool rotation;
    int q0, v0, nv;
    Mat by_rate;                     // for places: x' = by_rate x; empty: they do not rotate
    Eigen::Vector3d rate, relative;  // for rotations, in body axes: Omega, omega - Omega
  };
  const State& at_;
  double speed_;  // |Omega|
  Eigen::Vector3d rate_;
  std::vector<Part> parts_;
};

// [rad/s] The different angular velocities of rotating bodies, world axes.
std::vector<Eigen::Vector3d> body_rates(const model::Model& model, const State& at);

}  // namespace trammel::simulate
