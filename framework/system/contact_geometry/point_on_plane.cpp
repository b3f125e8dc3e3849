// A marker A, or a ball around it, and a plane that B carries: gap and slip, their rates and accelerations.
#include <Eigen/Geometry>

#include "model/model.hpp"

namespace trammel::model {

namespace {

// A vector in the plane or in space, with a compile-time size.
template <int dim>
using Point = Eigen::Matrix<double, dim, 1>;

// omega x r; omega is the angular part of a twist.
template <int dim>
Point<dim> cross(const Vec6& twist, const Point<dim>& r) {
  if constexpr (dim == 2)
    return {-twist(2) * r(1), twist(2) * r(0)};
  else
    return twist.tail<3>().cross(r);
}

// The row of a unit force d at the point r from the marker's origin: (d, r x d).
template <int dim>
void set_row(Mat6& H, int row, const Point<dim>& d, const Point<dim>& r, double sign) {
  for (int k = 0; k < dim; ++k) H(row, k) = sign * d(k);
  if constexpr (dim == 2) {
    H(row, 2) = sign * (r(0) * d(1) - r(1) * d(0));
  } else {
    const Eigen::Vector3d moment = r.cross(d);
    for (int k = 0; k < 3; ++k) H(row, 3 + k) = sign * moment(k);
  }
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

// gap = n . (x_A - p_B) - radius. With d = x_A - x_B, the point of B under A has the velocity of a point of B at d:
//     gap_rate = n . (V_A - V_B - omega_B x d)
//     gap_acceleration = n . (A_A - A_B - alpha_B x d) - n . omega_B x (omega_B x d) + n' . (V_A - V_B - omega_B x d)
//     ...
// collected in gamma with the relative velocity u in B's turning frame: gamma = n.(w x (w x d)) + 2 n.(w x u).
//
// A round body touches at r = -radius n from its centre, with changing material points, and slips with
//     s . u + (omega_A - omega_B) . (r x s),
// where r x s turns with B. In the plane the slip coordinate, whose rate this is, includes the angle that A has rolled.
template <int dim>
void contact_rows_in(const PointOnPlane& plane, const Motion& A, const Motion& B, bool tangents, Rows& rows) {
  const Eigen::Matrix<double, dim, dim> R = B.R.topLeftCorner<dim, dim>();
  const Point<dim> n = R * plane.normal.head<dim>();
  const Point<dim> d = A.x.head<dim>() - B.x.head<dim>();
  const Point<dim> r = -plane.radius * n;
  const Point<dim> swept = cross<dim>(B.V, d);
  // Velocity relative to B's frame, in world axes.
  const Point<dim> u = A.V.head<dim>() - B.V.head<dim>() - swept;
  const Point<dim> transport = cross<dim>(B.V, swept) + 2 * cross<dim>(B.V, u);

  rows.g(0) = n.dot(d - R * plane.point.head<dim>()) - plane.radius;
  set_row<dim>(rows.H_A, 0, n, r, 1);
  set_row<dim>(rows.H_B, 0, n, d, -1);
  rows.gamma(0) = n.dot(transport);
  if (!tangents) return;

  for (int i = 1; i < dim; ++i) {
    const Point<dim> s = R * plane.tangents.col(i - 1).head<dim>();
    set_row<dim>(rows.H_A, i, s, r, 1);
    set_row<dim>(rows.H_B, i, s, d + r, -1);
    rows.g(i) = s.dot(d);
    rows.gamma(i) = s.dot(transport);
    if constexpr (dim == 2) {
      const double arm = rows.H_A(i, 2);  // r x s
      rows.g(i) += arm * (A.angle - B.angle);
    } else {
      const Eigen::Vector3d spin = A.V.tail<3>() - B.V.tail<3>(), omega_B = B.V.tail<3>(), moment = r.cross(s);
      rows.gamma(i) -= spin.dot(omega_B.cross(moment));
    }
  }
}

void contact_rows(const PointOnPlane& plane, const Motion& A, const Motion& B, bool tangents, Rows& rows) {
  if (A.x.size() == 2)
    contact_rows_in<2>(plane, A, B, tangents, rows);
  else
    contact_rows_in<3>(plane, A, B, tangents, rows);
}

// gamma remains 0: it would contain the curvature of the surface, and only laws with rows use it.
void surface_row(double reach, const Motion& A, const Motion& B, Rows& rows) {
  const Vec3 d = A.x - B.x;
  const double length = d.norm();
  const Vec3 n = length > 0 ? Vec3(d / length) : Vec3(B.R.col(2));
  rows.g(0) = length - reach;
  rows.H_A.row(0).head(3) = n.transpose();
  rows.H_B.row(0).head(3) = -n.transpose();
}

}  // namespace trammel::model
