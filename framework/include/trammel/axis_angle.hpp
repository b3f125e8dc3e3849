// The angle of frame B against frame A about an axis fixed in A, with its exact gradient. Rotary springs, drives and
// gears measure it. In the plane it is the difference of the markers' angles, which counts full turns.
//
//     psi = atan2(y . w, x . w)        x, y, n: right-handed triad of A;  w: fixed in B, equal to x where R_A = R_B
//     psi' = h . (omega_B - omega_A),  h = (n - s w)/(1 - s^2),  s = n . w    s = 0 while B turns about the axis only
//
// In space psi [rad] lies in (-pi, pi]; counts_turns.hpp adds full turns. psi is not defined where B's w is parallel to
// the axis: OutsideDomain is thrown there.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include <trammel/marker.hpp>
#include <trammel/outside_domain.hpp>

namespace trammel {

class AxisAngle {
 public:
  AxisAngle() = default;
  explicit AxisAngle(const Eigen::Vector3d& unit_axis) : n_(unit_axis), x_(n_.unitOrthogonal()), y_(n_.cross(x_)) {}

  double angle(const Motion& A, const Motion& B) const {
    if (planar(A)) return B.angle - A.angle;
    const Eigen::Vector3d w = A.R.transpose() * (B.R * x_);
    return std::atan2(y_.dot(w), x_.dot(w));
  }

  // h in world axes (1 or 3 entries): the moment on B of a unit generalised force on psi; the moment on A is -h.
  Vec3 gradient(const Motion& A, const Motion& B) const {
    if (planar(A)) return Vec3::Ones(1);
    const auto [n, w, s] = directions(A, B);
    return Vec3(Eigen::Vector3d((n - s * w) / (1 - s * s)));
  }

  double rate(const Motion& A, const Motion& B) const {
    if (planar(A)) return B.V(2) - A.V(2);
    return gradient(A, B).dot(B.V.tail(3) - A.V.tail(3));
  }

  // dh/d(rotation of B) in space, with A at rest.
  Eigen::Matrix3d gradient_by_turn(const Motion& A, const Motion& B) const {
    const auto [n, w, s] = directions(A, B);
    const double c2 = 1 - s * s;
    const Eigen::Matrix3d tilde_w{{0, -w.z(), w.y()}, {w.z(), 0, -w.x()}, {-w.y(), w.x(), 0}};
    return (w * n.transpose() + s * Eigen::Matrix3d::Identity() - 2 * s / c2 * (n - s * w) * n.transpose()) / c2 *
           tilde_w;
  }

 private:
  struct Directions {
    Eigen::Vector3d n, w;
    double s;
  };
  static bool planar(const Motion& A) { return A.x.size() == 2; }
  Directions directions(const Motion& A, const Motion& B) const {
    const Eigen::Vector3d n = A.R * n_, w = B.R * x_;
    const double s = n.dot(w);
    constexpr double round_off = 1e-15;
    if (1 - s * s <= round_off)
      throw OutsideDomain(
          "it measures an angle about an axis that its B has tilted by a right angle, where there is none");
    return {n, w, s};
  }

  Eigen::Vector3d n_ = Eigen::Vector3d::UnitZ(), x_ = Eigen::Vector3d::UnitX(), y_ = Eigen::Vector3d::UnitY();
};

}  // namespace trammel
