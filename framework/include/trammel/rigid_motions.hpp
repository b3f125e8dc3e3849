// The velocities of a system that moves as one rigid body: where rows leave such a motion free, r^T M v is the momentum that they
// conserve.
#pragma once

#include <trammel/system.hpp>

namespace trammel {

// An ability of systems that consist of bodies.
class HasRigidMotions {
 public:
  virtual ~HasRigidMotions();
  // At the system's point, which is (t, q), a column each (nv x 3 in the plane, nv x 6 in space): 1 m/s along each of the world's
  // axes, then 1 rad/s about those through its origin. False: a body does not give its momentum (HasMomentum in body.hpp).
  [[nodiscard]] virtual bool rigid_motions(double t, const Vec& q, Mat& r) = 0;
};

}  // namespace trammel
