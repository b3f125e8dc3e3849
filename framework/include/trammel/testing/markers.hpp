// Markers in known motions, with exact velocities and accelerations: what joints and forces are tried between.
//
// A marker's coordinates are x, y, angle in the plane; x, y, z and three angles in space, R = R_x R_y R_z of them.
#pragma once

#include <vector>

#include <trammel/marker.hpp>

namespace trammel {

// At coordinates q with rates v; 3 or 6 of them tell the space.
Motion marker_at(const Vec& q, const Vec& v);
// The same marker with its pose moved by a twist: x by its linear part, R turned by its angular part in world axes.
Motion displaced(const Motion& m, const Vec6& by);
// A wrench at x as force and moment about the world's origin.
Vec about_origin(const Vec& wrench, const Vec3& x);

// Each coordinate runs along p + u t + a sin(w t + phi).
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

// Two of them in general motion, about one metre apart, turning less than half a turn against each other.
struct MovingPair {
  MovingMarker a, b;
};
MovingPair moving_pair(Space space);
// These two, and more like them: up to four.
std::vector<MovingMarker> moving_markers(Space space, int count);

}  // namespace trammel
