// A plane fixed to a marker B, pressed by points p of a surface.
//
//     r = x_p - x_m:   n = R_m n_0,   gap = n . (r - R_m p_0) - h/2,   gap_rate = n . u,   u = v_p - v_m - omega x r
//     s = u - (n . u) n;              F on the point; on the marker -F, -r x F
//
// n_0, p_0: normal and point in the marker's axes; h/2: half the thickness of the sheet. With a small rotation theta of
// the marker
//
//     dn = theta x n,   dgap = n . (dr - theta x r),   drate = dn . u + n . du,   ds = du - drate n - (n . u) dn
//
// Derivatives are by the point's position, the marker's position and its rotation, three columns each, or by the three
// velocities.
#pragma once

#include "system/contact_geometry/point_pressure.hpp"
#include "system/markers/marker_motions.hpp"

namespace trammel::model {

struct PressingPlane {
  using V3 = Eigen::Vector3d;
  using M3 = Eigen::Matrix3d;

  static constexpr bool marker_is_A = false;
  V3 origin, velocity, omega, n, point;
  double half_thickness;

  PressingPlane(const PointOnPlane& geometry, const Motion& m, double thick)
      : origin(m.x),
        velocity(m.V.head<3>()),
        omega(m.V.tail<3>()),
        n(m.R * geometry.normal),
        point(m.R * geometry.point),
        half_thickness(thick) {}

  double gap(const V3& x) const { return n.dot(x - origin - point) - half_thickness; }
  double gap_to_box(const V3& low, const V3& high) const {
    return gap((low + high) / 2) - n.cwiseAbs().dot(high - low) / 2;
  }
  void look(const V3& x, const V3& v, PressedPoint& at) const {
    const V3 u = v - velocity - omega.cross(x - origin);
    at.n = n;
    at.gap = gap(x), at.rate = n.dot(u);
    at.slip = u - at.rate * n;
  }
  V3 on_point(const V3& F) const { return F; }
  Wrench on_marker(const PressedPoint& at, const V3& x) const {
    Wrench w(6);
    w << -at.F, -(x - origin).cross(at.F);
    return w;
  }
  void by_position(const PressedPoint& at, const V3& x, const V3& v, MarkerPointChange& by) const {
    const V3 r = x - origin, u = v - velocity - omega.cross(r);
    const M3 turned = cross_matrix(omega);
    by.n << M3::Zero(), M3::Zero(), -cross_matrix(n);
    by.gap << n.transpose(), -n.transpose(), n.cross(r).transpose();
    M39 du;
    du << -turned, turned, M3::Zero();
    by.rate = u.transpose() * by.n + n.transpose() * du;
    by.slip = du - n * by.rate - at.rate * by.n;
  }
  void by_velocity(const PressedPoint&, const V3& x, MarkerPointChange& by) const {
    const M3 P = M3::Identity() - n * n.transpose();
    M39 du;
    du << M3::Identity(), -M3::Identity(), cross_matrix(x - origin);
    by.n.setZero(), by.gap.setZero();
    by.rate = n.transpose() * du;
    by.slip = P * du;
  }
  M69 change_on_marker(const PressedPoint& at, const V3& x, const M39& F, const MarkerPointChange&, bool moves) const {
    M69 w;
    w << -F, -cross_matrix(x - origin) * F;
    if (moves) w.block<3, 3>(3, 0) += cross_matrix(at.F), w.block<3, 3>(3, 3) -= cross_matrix(at.F);
    return w;
  }
};

}  // namespace trammel::model
