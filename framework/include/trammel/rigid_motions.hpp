// The velocities of a system that moves as one rigid body: where rows leave such a motion free, r^T M v is the momentum that they
// leave alone.
#pragma once

#include <trammel/system.hpp>

namespace trammel {

// At the system's point, which is (t, q), a column each (nv x 3 in the plane, nv x 6 in space): 1 m/s along each of the world's axes,
// then 1 rad/s about those through its origin. False: some body does not tell its momentum (HasMomentum in body.hpp), or the system
// knows of no bodies.
[[nodiscard]] bool rigid_motions(System& s, double t, const Vec& q, Mat& r);

}  // namespace trammel
