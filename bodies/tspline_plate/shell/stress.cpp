#include "tspline_plate/shell/stress.hpp"

#include <algorithm>
#include <cmath>

#include "tspline_plate/shell/pole_point.hpp"

namespace trammel::plate {

namespace {

constexpr int points_a_cell = 3;  // of the grid, each way, ends included

}  // namespace

StressState stress(const Discretisation& mesh, const Section& section, const SurfacePoint& point, In q) {
  const Cell& cell = mesh.cells[std::size_t(point.cell)];
  Vectors5 reference = Vectors5::Zero(), d = Vectors5::Zero();
  const ShapeValues& s = point.shape;
  const Eigen::VectorXd* rows[] = {&s.R_u, &s.R_v, &s.R_uu, &s.R_vv, &s.R_uv};
  for (int k = 0; k < 5; ++k) {
    for (int f = 0; f < cell.functions; ++f)
      reference.row(k) += (*rows[k])(f)*mesh.points.row(cell.nodes[std::size_t(f)]);
    for (const Cell::Local& t : cell.terms)
      d(k, t.component % 3) += (*rows[k])(t.component / 3) * t.factor * q(cell.dofs[std::size_t(t.dof)]);
  }
  ReferencePoint at_rest;
  if (!at_rest.set(reference, section)) return {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  DeformedPoint at;
  deform(at_rest, d, at);
  const Matrix3 C = plane_stress(section) * at_rest.T;
  const Vector3 membrane = C * at.eps, bending = section.thickness / 2 * (C * at.kappa);
  return {membrane - bending, membrane, membrane + bending};
}

double von_mises(const Eigen::Vector3d& s) {
  return std::sqrt(s.x() * s.x() - s.x() * s.y() + s.y() * s.y() + 3 * s.z() * s.z());
}

LargestStress largest_stress(const Discretisation& mesh, const Section& section, In q) {
  LargestStress result;
  SurfacePoint point;
  for (int c = 0; c < int(mesh.cells.size()); ++c) {
    const auto& [low, high] = mesh.basis.cells()[std::size_t(c)].parameters;
    point.cell = c;
    for (int j = 0; j < points_a_cell; ++j)
      for (int i = 0; i < points_a_cell; ++i) {
        const double a = double(i) / (points_a_cell - 1), b = double(j) / (points_a_cell - 1);
        const Eigen::Vector2d at =
            beside_pole(mesh, {low[0] + a * (high[0] - low[0]), low[1] + b * (high[1] - low[1])});
        mesh.basis.evaluate(c, at.x(), at.y(), point.shape);
        const StressState s = stress(mesh, section, point, q);
        result.bottom = std::max(result.bottom, von_mises(s.bottom));
        result.middle = std::max(result.middle, von_mises(s.middle));
        result.top = std::max(result.top, von_mises(s.top));
      }
  }
  return result;
}

}  // namespace trammel::plate
