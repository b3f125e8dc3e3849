// A sphere around a marker A that presses on points p of a surface.
//
//     d = x_m - x_p, l = |d|:   n = d/l,   gap = l - R - h/2,   gap_rate = n . u,   u = v_m - v_p
//     s = u - (n . u) n - R omega x n      slip of its surface;    on the marker F, -R n x F; -F on the point
//
// R: radius; h/2: half the thickness of the sheet. With a small rotation theta of the marker and P = 1 - n n^T
//
//     dn = P dd/l,   drate = dn . u + n . du,   ds = du - drate n - (n . u) dn - R (domega x n + omega x dn)
//
// Derivatives are by the point's position, the marker's position and its rotation, three columns each, or by the three
// velocities.
#pragma once

#include "system/contact_geometry/point_pressure.hpp"
#include "system/markers/marker_motions.hpp"

namespace trammel::model {

struct PressingSphere {
  using V3 = Eigen::Vector3d;
  using M3 = Eigen::Matrix3d;

  static constexpr bool marker_is_A = true;
  V3 centre, velocity, omega;
  double radius, reach;

  PressingSphere(const PointOnPlane& geometry, const Motion& m, double half_thickness)
      : centre(m.x),
        velocity(m.V.head<3>()),
        omega(m.V.tail<3>()),
        radius(geometry.radius),
        reach(radius + half_thickness) {}

  double gap(const V3& x) const { return (centre - x).norm() - reach; }
  double gap_to_box(const V3& low, const V3& high) const {  // lower bound
    return (low - centre).cwiseMax(centre - high).cwiseMax(0.0).norm() - reach;
  }
  void look(const V3& x, const V3& v, PressedPoint& at) const {
    const V3 d = centre - x, u = velocity - v;
    const double l = d.norm();
    at.n = d / l;
    at.gap = l - reach, at.rate = at.n.dot(u);
    at.slip = u - at.rate * at.n - radius * omega.cross(at.n);
  }
  V3 on_point(const V3& F) const { return -F; }
  Wrench on_marker(const PressedPoint& at, const V3&) const {
    Wrench w(6);
    w << at.F, -radius * at.n.cross(at.F);
    return w;
  }
  void by_position(const PressedPoint& at, const V3& x, const V3& v, MarkerPointChange& by) const {
    const V3 u = velocity - v;
    const M3 P = (M3::Identity() - at.n * at.n.transpose()) / (centre - x).norm();
    by.n << -P, P, M3::Zero();
    by.gap << -at.n.transpose(), at.n.transpose(), Eigen::RowVector3d::Zero();
    by.rate = u.transpose() * by.n;
    by.slip = -at.n * by.rate - at.rate * by.n - radius * cross_matrix(omega) * by.n;
  }
  void by_velocity(const PressedPoint& at, const V3&, MarkerPointChange& by) const {
    const M3 P = M3::Identity() - at.n * at.n.transpose();
    by.n.setZero(), by.gap.setZero();
    by.rate << -at.n.transpose(), at.n.transpose(), Eigen::RowVector3d::Zero();
    by.slip << -P, P, radius * cross_matrix(at.n);
  }
  M69 change_on_marker(const PressedPoint& at, const V3&, const M39& F, const MarkerPointChange& by,
                       bool /*moves*/) const {
    M69 w;
    w << F, radius * (cross_matrix(at.F) * by.n - cross_matrix(at.n) * F);
    return w;
  }
};

}  // namespace trammel::model
