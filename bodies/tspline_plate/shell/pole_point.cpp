#include "tspline_plate/shell/pole_point.hpp"

#include <algorithm>

namespace trammel::plate {

namespace {

constexpr double vanished = 1e-9;   // of the other tangent: a shorter one vanishes
constexpr double beside_it = 1e-6;  // of the way to the middle of the patch

bool on_border(const Discretisation& mesh, const Eigen::Vector2d& at) {
  const auto [low, high] = mesh.basis.range(mesh.basis.patch_at(at.x()));
  return at.x() <= low[0] || at.x() >= high[0] || at.y() <= low[1] || at.y() >= high[1];
}

}  // namespace

std::optional<int> turning_at_pole(const Discretisation& mesh, const Eigen::Vector2d& at) {
  if (!on_border(mesh, at)) return {};
  ShapeValues shape;
  const int cell = mesh.basis.cell_at(at.x(), at.y());
  mesh.basis.evaluate(cell, at.x(), at.y(), shape);
  const auto& nodes = mesh.basis.cells()[std::size_t(cell)].functions;
  Vector3 a1 = Vector3::Zero(), a2 = Vector3::Zero();
  for (std::size_t f = 0; f < nodes.size(); ++f) {
    const Vector3 P = mesh.points.row(nodes[f]);
    a1 += shape.R_u(Eigen::Index(f)) * P, a2 += shape.R_v(Eigen::Index(f)) * P;
  }
  if (std::min(a1.norm(), a2.norm()) > vanished * std::max(a1.norm(), a2.norm())) return {};
  return a1.norm() < a2.norm() ? 0 : 1;
}

Eigen::Vector2d beside_pole(const Discretisation& mesh, const Eigen::Vector2d& at) {
  if (!turning_at_pole(mesh, at)) return at;
  const auto [low, high] = mesh.basis.range(mesh.basis.patch_at(at.x()));
  const Eigen::Vector2d middle((low[0] + high[0]) / 2, (low[1] + high[1]) / 2);
  return at + beside_it * (middle - at);
}

}  // namespace trammel::plate
