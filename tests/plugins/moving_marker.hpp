// Markers that move along known laws of time, with exact velocities and accelerations, for tests of joints and forces.
#pragma once

#include <cmath>
#include <vector>

#include <trammel/marker.hpp>

namespace trammel::test {

// Each coordinate (planar: x, y, angle; spatial: x, y, z of a point) runs along p + u t + a sin(w t + phi).
class MovingMarker {
 public:
  struct Law {
    double p, u, a, w, phi;
  };
  explicit MovingMarker(std::vector<Law> laws, Space space = Space::planar) : laws_(std::move(laws)), space_(space) {}

  // `shift` displaces the coordinates by constants.
  Motion at(double t, const Vec& shift = Vec()) const {
    Vec q = each([t](const Law& l) { return l.p + l.u * t + l.a * std::sin(l.w * t + l.phi); });
    if (shift.size()) q += shift;
    return motion(q, each([t](const Law& l) { return l.u + l.a * l.w * std::cos(l.w * t + l.phi); }));
  }

  // The marker at rest at coordinates q, or moving with rates v.
  Motion motion(const Vec& q, const Vec& v) const {
    const int n = dimension(space_);
    Motion m;
    m.x = q.head(n);
    m.V = Vec6::Zero(twist_size(space_));
    m.V.head(v.size()) = v;
    m.R = Mat3::Identity(n, n);
    if (space_ == Space::planar) {
      m.angle = q(2);
      m.R << std::cos(q(2)), -std::sin(q(2)), std::sin(q(2)), std::cos(q(2));
    }
    return m;
  }

  Vec6 acceleration(double t) const {
    Vec6 a = Vec6::Zero(twist_size(space_));
    a.head(Eigen::Index(laws_.size())) =
        each([t](const Law& l) { return -l.a * l.w * l.w * std::sin(l.w * t + l.phi); });
    return a;
  }

  Eigen::Index size() const { return Eigen::Index(laws_.size()); }

 private:
  template <class F>
  Vec each(F f) const {
    Vec values(size());
    for (Eigen::Index i = 0; i < size(); ++i) values(i) = f(laws_[std::size_t(i)]);
    return values;
  }
  std::vector<Law> laws_;
  Space space_;
};

// Two of them, in general motion.
inline MovingMarker marker_a() {
  return MovingMarker({{0.3, 0.2, 0.5, 2.1, 0.4}, {-0.2, 0.4, 0.3, 1.7, 1.1}, {0.5, 1.3, 0.6, 2.6, 0.2}});
}
inline MovingMarker marker_b() {
  return MovingMarker({{1.4, -0.3, 0.4, 1.9, 0.9}, {0.8, 0.1, 0.5, 2.3, 0.3}, {-0.7, 0.8, 0.9, 1.6, 2.0}});
}
inline MovingMarker point_a() {
  return MovingMarker({{0.3, 0.2, 0.5, 2.1, 0.4}, {-0.2, 0.4, 0.3, 1.7, 1.1}, {0.5, 0.3, 0.6, 1.6, 0.2}},
                      Space::spatial);
}
inline MovingMarker point_b() {
  return MovingMarker({{1.4, -0.3, 0.4, 1.9, 0.9}, {0.8, 0.1, 0.5, 2.3, 0.3}, {1.7, 0.2, 0.4, 1.6, 2.0}},
                      Space::spatial);
}

// Derivative of a smooth function of one number by five points; the error is about h^4 f'''''/30 + eps |f| / h ~ 1e-12.
template <class F>
auto derivative(F f, double at, double h = 1e-3) {
  using T = decltype(f(at));
  return T((8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * h));
}

// Of values of order one to ten: the derivative's error, with some room.
constexpr double difference_error = 1e-9;

}  // namespace trammel::test
