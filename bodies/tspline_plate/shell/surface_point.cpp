#include "tspline_plate/shell/surface_point.hpp"

#include "tspline_plate/shell/pole_point.hpp"

namespace trammel::plate {

// At a pole one tangent vanishes; the tangents at a point close to it span the tangent plane.
SurfacePoint surface_point(const Discretisation& mesh, double u, double v, double height) {
  SurfacePoint point;
  point.cell = mesh.basis.cell_at(u, v);
  point.height = height;
  mesh.basis.evaluate(point.cell, u, v, point.shape);
  if (turning_at_pole(mesh, {u, v})) {
    const Eigen::VectorXd R = point.shape.R;
    const Eigen::Vector2d beside = beside_pole(mesh, {u, v});
    mesh.basis.evaluate(point.cell, beside.x(), beside.y(), point.shape);
    point.shape.R = R;
  }
  return point;
}

Place place_rate(const Discretisation& mesh, const SurfacePoint& point, In v) {
  const Cell& cell = mesh.cells[std::size_t(point.cell)];
  Place p{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  for (const Cell::Local& t : cell.terms) {
    const int axis = t.component % 3;
    const Eigen::Index f = t.component / 3;
    const double value = t.factor * v(cell.dofs[std::size_t(t.dof)]);
    p.r(axis) += point.shape.R(f) * value;
    p.a1(axis) += point.shape.R_u(f) * value;
    p.a2(axis) += point.shape.R_v(f) * value;
  }
  return p;
}

Place place(const Discretisation& mesh, const SurfacePoint& point, In q) {
  Place p = place_rate(mesh, point, q);
  const Cell& cell = mesh.cells[std::size_t(point.cell)];
  for (int f = 0; f < cell.functions; ++f) {
    const Vector3 P = mesh.points.row(cell.nodes[std::size_t(f)]);
    p.r += point.shape.R(f) * P;
    p.a1 += point.shape.R_u(f) * P;
    p.a2 += point.shape.R_v(f) * P;
  }
  return p;
}

namespace {

struct MovingFrame {
  Vector3 e1, e2, n;
  double l, s, d;

  MovingFrame(const Vector3& a1, const Vector3& a2) {
    l = a1.norm();
    e1 = a1 / l;
    n = a1.cross(a2).normalized();
    e2 = n.cross(e1);
    s = a2.dot(e1), d = a2.dot(e2);
  }
  Matrix3 W1() const { return (-s / (l * d) * e1 - e2 / l) * n.transpose() + n * (e2 / l).transpose(); }
  Matrix3 W2() const { return e1 * (n / d).transpose(); }
};

// omega' at constant a_1' = v1 and a_2' = v2: the derivative of omega's components, as omega x omega = 0.
Vector3 angular_bias(const MovingFrame& f, const Vector3& a2, const Vector3& v1, const Vector3& v2,
                     const Vector3& omega) {
  const Vector3 n_rate = omega.cross(f.n), e1_rate = omega.cross(f.e1), e2_rate = omega.cross(f.e2);
  const double l_rate = f.e1.dot(v1), s_rate = v2.dot(f.e1) + a2.dot(e1_rate), d_rate = v2.dot(f.e2) + a2.dot(e2_rate);
  const double ratio_rate = (s_rate - f.s * l_rate / f.l) / f.l;  // of s / l
  const double along_1 =
      (n_rate.dot(v2) - f.s / f.l * n_rate.dot(v1) - ratio_rate * f.n.dot(v1) - omega.dot(f.e1) * d_rate) / f.d;
  const double along_2 = -n_rate.dot(v1) / f.l + f.n.dot(v1) * l_rate / (f.l * f.l);
  const double along_n = e2_rate.dot(v1) / f.l - f.e2.dot(v1) * l_rate / (f.l * f.l);
  return along_1 * f.e1 + along_2 * f.e2 + along_n * f.n;
}

Matrix3 cross_matrix(const Vector3& r) {
  return Matrix3{{0, -r.z(), r.y()}, {r.z(), 0, -r.x()}, {-r.y(), r.x(), 0}};
}

}  // namespace

void motion(const Discretisation& mesh, const SurfacePoint& point, In q, In v, Motion& m) {
  const Cell& cell = mesh.cells[std::size_t(point.cell)];
  const Place at = place(mesh, point, q), rate = place_rate(mesh, point, v);
  const MovingFrame f(at.a1, at.a2);
  const Matrix3 W1 = f.W1(), W2 = f.W2();
  const Vector3 omega = W1 * rate.a1 + W2 * rate.a2, arm = point.height * f.n;
  const Vector3 alpha = angular_bias(f, at.a2, rate.a1, rate.a2, omega);

  m.x = at.r + arm;
  m.R.resize(3, 3);
  m.R << f.e1, f.e2, f.n;
  m.angle = 0;
  m.V.resize(6), m.bias.resize(6);
  m.V << rate.r + omega.cross(arm), omega;
  m.bias << alpha.cross(arm) + omega.cross(omega.cross(arm)), alpha;

  if (m.dofs != cell.dofs) m.dofs = cell.dofs;
  m.J.setZero(6, Eigen::Index(cell.dofs.size()));
  const Matrix3 lever = -cross_matrix(arm);  // V += omega x arm
  for (const Cell::Local& t : cell.terms) {
    const int axis = t.component % 3;
    const Eigen::Index k = t.component / 3;
    const Vector3 turn = t.factor * (point.shape.R_u(k) * W1.col(axis) + point.shape.R_v(k) * W2.col(axis));
    m.J(axis, t.dof) += t.factor * point.shape.R(k);
    m.J.col(t.dof).head<3>() += lever * turn;
    m.J.col(t.dof).tail<3>() += turn;
  }
}

void add_tangent_of_tangents(const Cell& cell, const ShapeValues& s, const Eigen::Matrix<double, 6, 6>& D, double c,
                             Matrix& S) {
  for (const Cell::Local& row : cell.terms) {
    const int i = row.component % 3;
    const Eigen::Index I = row.component / 3;
    if (s.R_u(I) == 0 && s.R_v(I) == 0) continue;
    const Eigen::Matrix<double, 1, 6> left = s.R_u(I) * D.row(i) + s.R_v(I) * D.row(3 + i);
    for (const Cell::Local& column : cell.terms) {
      const int j = column.component % 3;
      const Eigen::Index J = column.component / 3;
      const double value = left(j) * s.R_u(J) + left(3 + j) * s.R_v(J);
      if (value != 0)
        S.add(cell.dofs[std::size_t(row.dof)], cell.dofs[std::size_t(column.dof)],
              c * row.factor * column.factor * value);
    }
  }
}

// J^T F = R F + R_u W_1^T m + R_v W_2^T m with the moment m of F about the surface. It varies with the frame.
void add_reaction_derivative(const Discretisation& mesh, const SurfacePoint& point, In q, const Wrench& F, double c,
                             Matrix& S) {
  const Place at = place(mesh, point, q);
  const MovingFrame f(at.a1, at.a2);
  const Vector3 arm = point.height * f.n, force = F.head<3>(), m = Vector3(F.tail<3>()) + arm.cross(force);
  const Matrix3 W[2] = {f.W1(), f.W2()};
  Eigen::Matrix<double, 6, 6> D;
  for (int b = 0; b < 2; ++b)
    for (int i = 0; i < 3; ++i) {
      const Vector3 turn = W[b].col(i);
      const Vector3 de1 = turn.cross(f.e1), de2 = turn.cross(f.e2), dn = turn.cross(f.n);
      const double dl = b == 0 ? f.e1(i) : 0;
      const double ds = (b == 1 ? f.e1(i) : 0) + at.a2.dot(de1), dd = (b == 1 ? f.e2(i) : 0) + at.a2.dot(de2);
      const Vector3 dm = turn.cross(arm).cross(force);
      const double k = f.s / (f.l * f.d), dk = (ds - f.s * dl / f.l - f.s * dd / f.d) / (f.l * f.d);
      const double m1 = m.dot(f.e1), m2 = m.dot(f.e2), mn = m.dot(f.n);
      const double dm1 = dm.dot(f.e1) + m.dot(de1), dm2 = dm.dot(f.e2) + m.dot(de2), dmn = dm.dot(f.n) + m.dot(dn);
      const double along_n = -k * m1 - m2 / f.l, along_2 = mn / f.l;
      const double d_along_n = -dk * m1 - k * dm1 - dm2 / f.l + m2 * dl / (f.l * f.l);
      const double d_along_2 = dmn / f.l - mn * dl / (f.l * f.l);
      D.block<3, 1>(0, 3 * b + i) = d_along_n * f.n + along_n * dn + d_along_2 * f.e2 + along_2 * de2;
      D.block<3, 1>(3, 3 * b + i) = (dm1 / f.d - m1 * dd / (f.d * f.d)) * f.n + m1 / f.d * dn;
    }
  add_tangent_of_tangents(mesh.cells[std::size_t(point.cell)], point.shape, D, c, S);
}

}  // namespace trammel::plate
