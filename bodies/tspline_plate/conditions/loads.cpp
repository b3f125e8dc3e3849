#include "tspline_plate/conditions/loads.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <trammel/quadrature.hpp>

#include "tspline_plate/shell/simd_loops.hpp"

namespace trammel::plate {

namespace {

// The bases at a point of an edge, and the factors a^1 . nu, a^2 . nu.
struct EdgeFrame {
  Vector3 a[2], dual[2], n, run, nu;
  double metric[2][2], side;  // side: nu = side run x n
  int along;                  // which of a_1, a_2 runs along the edge

  EdgeFrame(const Edge& edge, const Place& at) : a{at.a1, at.a2}, along(edge.direction == 0 ? 1 : 0) {
    const Vector3 cross = a[0].cross(a[1]);
    const double det = cross.squaredNorm();
    n = cross / std::sqrt(det);
    metric[0][0] = a[1].squaredNorm() / det, metric[1][1] = a[0].squaredNorm() / det;
    metric[0][1] = metric[1][0] = -a[0].dot(a[1]) / det;
    for (int i = 0; i < 2; ++i) dual[i] = metric[i][0] * a[0] + metric[i][1] * a[1];
    run = a[along].normalized();
    // a_2 x n points to higher u, a_1 x n to lower v.
    side = (edge.direction == 0) == edge.high ? 1 : -1;
    nu = side * run.cross(n);
  }
};

}  // namespace

std::vector<EdgePoint> edge_points(const Discretisation& mesh, int patch, const Edge& edge) {
  const TsplineBasis& basis = mesh.basis.patch(patch);
  const auto along = std::size_t(1 - edge.direction), across = std::size_t(edge.direction);
  const auto& knots = basis.mesh().knots(edge.direction);
  const double border = edge.high ? knots.back() : knots.front();
  const Vec rest = Vec::Zero(mesh.coordinates.coordinates());
  std::vector<EdgePoint> result;
  for (const BezierCell& cell : basis.cells()) {
    const auto& box = cell.parameters;
    if ((edge.high ? box.high : box.low)[across] != border) continue;
    const Quadrature rule = gauss_legendre(degree + 1, box.low[along], box.high[along]);
    for (Eigen::Index k = 0; k < rule.x.size(); ++k) {
      const Eigen::Vector2d at = on_edge(basis, edge, rule.x(k));
      EdgePoint point{surface_point(mesh, at.x(), at.y()), 0, {}};
      const EdgeFrame frame(edge, place(mesh, point.point, rest));
      point.length = rule.weight(k) * frame.a[frame.along].norm();
      point.outward = frame.nu;
      result.push_back(std::move(point));
    }
  }
  return result;
}

void add_edge_moment(const Discretisation& mesh, const Edge& edge, const std::vector<EdgePoint>& points, double moment,
                     In q, Out f) {
  for (const EdgePoint& p : points) {
    const Cell& cell = mesh.cells[std::size_t(p.point.cell)];
    const EdgeFrame frame(edge, place(mesh, p.point, q));
    const double by_u = frame.dual[0].dot(frame.nu), by_v = frame.dual[1].dot(frame.nu);
    for (const Cell::Local& t : cell.terms) {
      const Eigen::Index I = t.component / 3;
      f(cell.dofs[std::size_t(t.dof)]) += t.factor * moment * p.length * frame.n(t.component % 3) *
                                          (p.point.shape.R_u(I) * by_u + p.point.shape.R_v(I) * by_v);
    }
  }
}

void add_edge_moment_tangent(const Discretisation& mesh, const Edge& edge, const std::vector<EdgePoint>& points,
                             double moment, In q, double c, Matrix& S) {
  for (const EdgePoint& p : points) {
    const EdgeFrame f(edge, place(mesh, p.point, q));
    Eigen::Matrix<double, 6, 6> D;
    for (int b = 0; b < 2; ++b)
      for (int i = 0; i < 3; ++i) {
        const Vector3 dn = -f.n(i) * f.dual[b];
        Vector3 d_run = Vector3::Zero();
        if (b == f.along) d_run = (Vector3::Unit(i) - f.run(i) * f.run) / f.a[b].norm();
        const Vector3 d_nu = f.side * (d_run.cross(f.n) + f.run.cross(dn));
        for (int a = 0; a < 2; ++a) {
          const Vector3 d_dual = -f.dual[a](i) * f.dual[b] + f.metric[a][b] * f.n(i) * f.n;
          D.block<3, 1>(3 * a, 3 * b + i) = (d_dual.dot(f.nu) + f.dual[a].dot(d_nu)) * f.n + f.dual[a].dot(f.nu) * dn;
        }
      }
    add_tangent_of_tangents(mesh.cells[std::size_t(p.point.cell)], p.point.shape, D, -c * moment * p.length, S);
  }
}

void add_pressure(const Cell& cell, const CellVectors& u, double pressure, CellVectors& f) {
  const int n = cell.padded;
  Vectors5 d;
  for (std::size_t p = 0; p < cell.points.size(); ++p) {
    const ReferencePoint& reference = cell.points[p];
    interpolate(n, &cell.shape[p * 5 * std::size_t(n)], u, d.data());
    const Vectors5 y = reference.Y + d;
    const Vector3 force = pressure * cell.weight[p] / reference.area * Vector3(y.row(0)).cross(Vector3(y.row(1)));
    const double* R = &cell.value[p * std::size_t(n)];
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < n; ++i) f[axis * n + i] += force(axis) * R[i];
  }
}

void add_pressure_tangent(const Cell& cell, const CellVectors& u, double pressure, double c, double* block) {
  const int n = cell.padded, size = 3 * cell.functions;
  Vectors5 d;
  for (std::size_t p = 0; p < cell.points.size(); ++p) {
    const ReferencePoint& reference = cell.points[p];
    const double* shape = &cell.shape[p * 5 * std::size_t(n)];
    const double* R = &cell.value[p * std::size_t(n)];
    interpolate(n, shape, u, d.data());
    const Vector3 a1 = reference.Y.row(0) + d.row(0), a2 = reference.Y.row(1) + d.row(1);
    const double factor = -c * pressure * cell.weight[p] / reference.area;
    for (int J = 0; J < cell.functions; ++J)
      for (int j = 0; j < 3; ++j) {
        const Vector3 unit = Vector3::Unit(j);
        const Vector3 change = factor * (shape[J] * unit.cross(a2) + shape[n + J] * a1.cross(unit));
        double* column = block + (3 * J + j) * size;
        for (int I = 0; I < cell.functions; ++I)
          for (int i = 0; i < 3; ++i) column[3 * I + i] += R[I] * change(i);
      }
  }
}

}  // namespace trammel::plate
