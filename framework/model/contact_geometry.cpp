#include <Eigen/Geometry>

#include <trammel/marker.hpp>

#include "model/model.hpp"

namespace trammel {

void Rows::resize(int n, Space space) {
  const int twist = twist_size(space);
  g.setZero(n);
  g_t.setZero(n);
  gamma.setZero(n);
  H_A.setZero(n, twist);
  H_B.setZero(n, twist);
}

namespace model {

namespace {

// omega x r in the plane and in space; omega is the angular part of a twist.
Vec3 cross(const Vec6& twist, const Vec3& r) {
  if (r.size() == 2) return Eigen::Vector2d(-twist(2) * r(1), twist(2) * r(0));
  return Eigen::Vector3d(twist.tail<3>()).cross(Eigen::Vector3d(r));
}

// The row of a unit force d through the point r away from the marker's origin: (d, r x d).
void set_row(Mat6& H, int row, const Vec3& d, const Vec3& r, double sign) {
  const auto n = d.size();
  H.row(row).head(n) = sign * d.transpose();
  if (n == 2)
    H(row, 2) = sign * (r(0) * d(1) - r(1) * d(0));
  else
    H.row(row).tail<3>() = sign * Eigen::Vector3d(r).cross(Eigen::Vector3d(d)).transpose();
}

}  // namespace

PointOnPlane::PointOnPlane(const Vec3& p, const Vec3& n) : point(p), normal(n) {
  if (n.size() == 2) {
    tangents = Eigen::Vector2d(n(1), -n(0));  // the free side to the left of the slip direction
  } else {
    const Eigen::Vector3d axis = n, first = axis.unitOrthogonal();
    tangents.resize(3, 2);
    tangents << first, axis.cross(first);
  }
}

// gap = n . (x_A - p_B) - radius. With d = x_A - x_B the point of B under A moves like a point at d, so
//     gap_rate = n . (V_A - V_B - omega_B x d)
//     gap_acceleration = n . (A_A - A_B - alpha_B x d) - n . omega_B x (omega_B x d) + n' . (V_A - V_B - omega_B x d)
//     ...
// collected in gamma with the relative velocity u in B's turning frame: gamma = n.(w x (w x d)) + 2 n.(w x u).
//
// A round body touches at r = -radius n from its centre, whichever of its points that is, and slips with
//     s . u + (omega_A - omega_B) . (r x s),
// where r x s turns with B. The coordinate of which this is the rate, in the plane, counts the angle that A has rolled.
void contact_rows(const PointOnPlane& plane, const Motion& A, const Motion& B, bool tangents, Rows& rows) {
  const Vec3 n = B.R * plane.normal;
  const Vec3 d = A.x - B.x;
  const auto dim = d.size();
  const Vec3 r = -plane.radius * n;
  const Vec3 swept = cross(B.V, d);
  const Vec3 u = A.V.head(dim) - B.V.head(dim) - swept;  // relative velocity, seen in B's frame, world axes
  const Vec3 transport = cross(B.V, swept) + 2 * cross(B.V, u);

  rows.g(0) = n.dot(d - B.R * plane.point) - plane.radius;
  set_row(rows.H_A, 0, n, r, 1);
  set_row(rows.H_B, 0, n, d, -1);
  rows.gamma(0) = n.dot(transport);
  if (!tangents) return;

  for (int i = 1; i < dim; ++i) {
    const Vec3 s = B.R * plane.tangents.col(i - 1);
    set_row(rows.H_A, i, s, r, 1);
    set_row(rows.H_B, i, s, d + r, -1);
    rows.g(i) = s.dot(d);
    rows.gamma(i) = s.dot(transport);
    const auto arm = rows.H_A.row(i).tail(rotations(dim == 2 ? Space::planar : Space::spatial));  // r x s
    if (dim == 2) {
      rows.g(i) += arm(0) * (A.angle - B.angle);
    } else {
      const Eigen::Vector3d spin = A.V.tail<3>() - B.V.tail<3>(), omega_B = B.V.tail<3>(), moment = arm.transpose();
      rows.gamma(i) -= spin.dot(omega_B.cross(moment));
    }
  }
}

}  // namespace model
}  // namespace trammel
