#include "tspline_plate/conditions/edge.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "tspline_plate/conditions/pole.hpp"

namespace trammel::plate {

namespace {

// [1] Round-off of directions: a component that is none, and the angle [rad] by which an edge may leave its plane.
constexpr double no_component = 1e-12, no_angle = 1e-9;
// Relative to the tangent along or across: a shorter one vanishes, as at a pole.
constexpr double vanished = 1e-9;

}  // namespace

EdgeRows rows(const TsplineBasis& basis, const Edge& edge) {
  const auto d = std::size_t(edge.direction);
  const int last = basis.mesh().edges().lines(edge.direction) - 1;
  const int edge_line = edge.high ? last - 2 : 2, second_line = edge.high ? last - 3 : 3;
  EdgeRows result;
  for (int i = 0; i < basis.size(); ++i) {
    const int line = basis.anchors()[std::size_t(i)].at[d];
    if (line == edge_line) result.edge.push_back(i);
    if (line == second_line) result.second.push_back(i);
  }
  return result;
}

Eigen::Vector2d on_edge(const TsplineBasis& basis, const Edge& edge, double along) {
  const auto& knots = basis.mesh().knots(edge.direction);
  const double across = edge.high ? knots.back() : knots.front();
  return edge.direction == 0 ? Eigen::Vector2d(across, along) : Eigen::Vector2d(along, across);
}

int corner_anchor(const TsplineBasis& basis, const Corner& corner) {
  const auto u = rows(basis, edges[corner.u_edge]).edge, v = rows(basis, edges[corner.v_edge]).edge;
  for (int i : u)
    if (std::find(v.begin(), v.end(), i) != v.end()) return i;
  throw std::logic_error("a patch without corners");
}

std::vector<int> axes_in(const std::string& text) {
  std::vector<int> result;
  for (char c : text) {
    if (c < 'x' || c > 'z') return {};
    if (std::find(result.begin(), result.end(), c - 'x') != result.end()) return {};
    result.push_back(c - 'x');
  }
  return result;
}

Tangents tangents(const PatchNet& net, const Eigen::Vector2d& at) {
  ShapeValues shape;
  const int cell = net.basis.cell_at(at.x(), at.y());
  net.basis.evaluate(cell, at.x(), at.y(), shape);
  Tangents t{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const auto& functions = net.basis.cells()[std::size_t(cell)].functions;
  for (std::size_t f = 0; f < functions.size(); ++f) {
    t.u += shape.R_u(Eigen::Index(f)) * net.point(functions[f]);
    t.v += shape.R_v(Eigen::Index(f)) * net.point(functions[f]);
    t.uv += shape.R_uv(Eigen::Index(f)) * net.point(functions[f]);
  }
  return t;
}

namespace {

// Greville abscissa along the edge: the middle of the control point's influence.
double abscissa(const TsplineBasis& basis, const Edge& edge, int anchor) {
  const LocalKnots& k = basis.anchors()[std::size_t(anchor)].knots[std::size_t(1 - edge.direction)];
  return (k[1] + k[2] + k[3]) / 3;
}

std::vector<Term> along(const PatchNet& net, int anchor, const Eigen::Vector3d& direction) {
  std::vector<Term> condition;
  for (int c = 0; c < 3; ++c) condition.push_back({net.component(anchor, c), direction(c)});
  return condition;
}

// Directions that are an axis up to round-off become one, so that holding them deletes a coordinate.
Eigen::Vector3d snapped(Eigen::Vector3d direction) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(direction(c)) < no_component) direction(c) = 0;
  return direction.normalized();
}

// Where an edge ends in a pole of the surface, its own tangent across vanishes there; a little before it does not.
constexpr double before_pole = 1.0 / 64;  // of the way to the middle of the edge

// The direction in the surface across the edge: the normal of the plane of symmetry.
Eigen::Vector3d across_edge(const PatchNet& net, const Edge& edge, int anchor) {
  double at = abscissa(net.basis, edge, anchor);
  Tangents t = tangents(net, on_edge(net.basis, edge, at));
  if ((edge.direction == 0 ? t.u : t.v).norm() < vanished * (edge.direction == 0 ? t.v : t.u).norm()) {
    const auto& knots = net.basis.mesh().knots(1 - edge.direction);
    at += before_pole * ((knots.front() + knots.back()) / 2 - at);
    t = tangents(net, on_edge(net.basis, edge, at));
  }
  const Eigen::Vector3d run = (edge.direction == 0 ? t.v : t.u).normalized();
  const Eigen::Vector3d across = edge.direction == 0 ? t.u : t.v;
  return snapped((across - across.dot(run) * run).normalized());
}

// The surface normal. At a pole, where the edge is one point, it follows from r_uv, the tangent just beside the pole.
Eigen::Vector3d normal(const Tangents& t, const Edge& edge) {
  const bool along_u = edge.direction == 1;
  const Eigen::Vector3d &run = along_u ? t.u : t.v, &across = along_u ? t.v : t.u;
  const bool pole = run.norm() < vanished * across.norm();
  return snapped((pole ? t.uv : run).cross(across).normalized());
}

void clamp_slope(const PatchNet& net, const Edge& edge, const EdgeRows& r, Elimination& e) {
  for (int i : r.second) {
    const Tangents t = tangents(net, on_edge(net.basis, edge, abscissa(net.basis, edge, i)));
    e.hold(along(net, i, normal(t, edge)));
  }
}

void mirror(const PatchNet& net, const Edge& edge, const EdgeRows& r, Elimination& e) {
  const Eigen::Vector3d normal = across_edge(net, edge, r.edge.front());
  for (int i : r.edge) {
    if (across_edge(net, edge, i).cross(normal).norm() > no_angle)
      throw std::invalid_argument(
          "symmetric: the edge does not lie in one plane that the surface meets at right angles");
    e.hold(along(net, i, normal));
  }
  const Eigen::Vector3d first = snapped(normal.unitOrthogonal()), second = snapped(normal.cross(first));
  for (std::size_t k = 0; k < r.edge.size(); ++k)
    for (const Eigen::Vector3d& direction : {first, second}) {
      auto tie = along(net, r.second[k], direction);
      for (const Term& t : along(net, r.edge[k], -direction)) tie.push_back(t);
      e.hold(std::move(tie));
    }
}

}  // namespace

void hold_edge(const PatchNet& net, const Edge& edge, const std::string& condition, Elimination& e) {
  if (condition == "free") return;
  if (condition == "pole") return hold_pole(net, edge, e);
  const EdgeRows r = rows(net.basis, edge);
  if (condition == "symmetric") return mirror(net, edge, r, e);
  const bool all = condition == "hinged" || condition == "clamped";
  const std::vector<int> axes = all ? std::vector<int>{0, 1, 2} : axes_in(condition);
  if (axes.empty())
    throw std::invalid_argument(
        fmt::format("found \"{}\", expected free, hinged, clamped, symmetric, pole or held axes such as "
                    "\"z\" or \"xz\"",
                    condition));
  for (int i : r.edge)
    for (int axis : axes) e.hold(net.component(i, axis));
  if (condition == "clamped") clamp_slope(net, edge, r, e);
}

void hold_corner(const PatchNet& net, const Corner& corner, const std::string& condition, Elimination& e) {
  if (condition == "free") return;
  const auto axes = condition == "hinged" ? std::vector<int>{0, 1, 2} : axes_in(condition);
  if (axes.empty())
    throw std::invalid_argument(
        fmt::format("found \"{}\", expected free, hinged or held axes such as \"z\"", condition));
  for (int axis : axes) e.hold(net.component(corner_anchor(net.basis, corner), axis));
}

}  // namespace trammel::plate
