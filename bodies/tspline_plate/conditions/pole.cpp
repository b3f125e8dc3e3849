#include "tspline_plate/conditions/pole.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/QR>

namespace trammel::plate {

namespace {

using Vector3 = Eigen::Vector3d;

// Conditions of symmetry and of seams that end here overlap with these, up to this round-off.
constexpr double known_to = 1e-8;
// Of the longest arm: the length of an edge that is one point, and the height of a tip that is none.
constexpr double one_point = 1e-9, no_tip = 1e-7;

// The arms from the point to the second row, and the two of them that determine the others.
struct Arms {
  std::vector<Vector3> arm;
  std::size_t a = 0, b = 0;

  Arms(const PatchNet& net, const EdgeRows& r) {
    for (int s : r.second) arm.push_back(net.point(s) - net.point(r.edge.front()));
    for (std::size_t k = 0; k < arm.size(); ++k)
      if (arm[k].norm() > arm[a].norm()) a = k;
    for (std::size_t k = 0; k < arm.size(); ++k)
      if (arm[a].cross(arm[k]).norm() > arm[a].cross(arm[b]).norm()) b = k;
  }
  double longest() const { return arm[a].norm(); }
  // alpha, beta of arm[k] = alpha arm[a] + beta arm[b].
  Eigen::Vector2d parts(std::size_t k) const {
    Eigen::Matrix<double, 3, 2> plane;
    plane << arm[a], arm[b];
    const Eigen::Vector2d found = plane.colPivHouseholderQr().solve(arm[k]);
    if (const double off = (plane * found - arm[k]).norm(); off > no_tip * longest())
      throw std::invalid_argument(
          fmt::format("pole: the surface has a tip there, {:.3g} m high over the next row of control points", off));
    return found;
  }
};

}  // namespace

void hold_pole(const PatchNet& net, const Edge& edge, Elimination& e) {
  const EdgeRows r = rows(net.basis, edge);
  const Arms arms(net, r);
  for (int i : r.edge)
    if (const double away = (net.point(i) - net.point(r.edge.front())).norm(); away > one_point * arms.longest())
      throw std::invalid_argument(fmt::format("pole: the edge is not one point, but {:.4g} m long or more", away));
  for (std::size_t k = 1; k < r.edge.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      e.hold({{net.component(r.edge[k], axis), 1}, {net.component(r.edge[0], axis), -1}}, known_to);
  for (std::size_t k = 0; k < r.second.size(); ++k) {
    if (k == arms.a || k == arms.b) continue;
    const Eigen::Vector2d part = arms.parts(k);
    for (int axis = 0; axis < 3; ++axis)
      e.hold({{net.component(r.second[k], axis), 1},
              {net.component(r.second[arms.a], axis), -part(0)},
              {net.component(r.second[arms.b], axis), -part(1)},
              {net.component(r.edge[0], axis), part.sum() - 1}},
             known_to);
  }
}

}  // namespace trammel::plate
