// The velocities of a system that moves as one rigid body. If the rows permit such a motion r, their reactions do not
// change the momentum r^T M v.
#pragma once

#include <trammel/system.hpp>

namespace trammel {

// Ability of a System that consists of bodies.
class HasRigidMotions {
 public:
  virtual ~HasRigidMotions();
  // Fills r at the system's point, which must be (t, q), with one motion per column (nv x 3 planar, nv x 6 spatial): 1
  // m/s along each world axis, then 1 rad/s about each axis through the origin. Returns false if a body lacks
  // HasMomentum (body.hpp).
  [[nodiscard]] virtual bool rigid_motions(double t, const Vec& q, Mat& r) = 0;
};

}  // namespace trammel
