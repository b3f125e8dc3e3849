// Markers in known motions, with exact velocities and accelerations, for tests of joints and forces.
//
// A marker's coordinates are x, y, angle in the plane; in space x, y, z and three angles with R = R_x R_y R_z.
#pragma once

#include <vector>

#include <trammel/marker.hpp>

namespace trammel {

// The marker at coordinates q with rates v: 3 each in the plane, 6 in space.
Motion marker_at(const Vec& q, const Vec& v);
// The same marker with its pose displaced by a twist: x by the linear part, R by a rotation about world axes.
Motion displaced(const Motion& m, const Vec6& by);
// A wrench at x as force and moment about the world's origin.
Vec about_origin(const Vec& wrench, const Vec3& x);

// Each coordinate follows p + u t + a sin(w t + phi).
class MovingMarker {
 public:
  struct Law {
    double p, u, a, w, phi;
  };
  explicit MovingMarker(std::vector<Law> laws) : laws_(std::move(laws)) {}

  Motion at(double t) const;
  Vec6 acceleration(double t) const;  // twist, world axes

 private:
  std::vector<Law> laws_;
};

// Two such markers in general motion, about one metre apart; their relative rotation stays below half a turn.
struct MovingPair {
  MovingMarker a, b;
};
MovingPair moving_pair(Space space);
// The same two markers and further ones, up to four.
std::vector<MovingMarker> moving_markers(Space space, int count);

}  // namespace trammel
