#include "tspline_plate/conditions/seam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace trammel::plate {

namespace {

constexpr double same_place = 1e-9;  // of the size of the plate; and of angles, ratios and parameters from 0 to 1
// Of angles and ratios of arms to second rows, which are shorter than the plate.
constexpr double same_across = 1e2 * same_place;

PatchNet net_of(const Multipatch& basis, const Points& points, int patch) {
  return {basis.patch(patch), points, basis.first_function(patch)};
}

// Converts a position along the edge, from 0 to 1, to the parameter of the mesh, and back.
double from_unit(const TMesh& mesh, const Edge& edge, double s) {
  const auto& k = mesh.knots(1 - edge.direction);
  return k.front() + s * (k.back() - k.front());
}
double to_unit(const TMesh& mesh, const Edge& edge, double parameter) {
  const auto& k = mesh.knots(1 - edge.direction);
  return (parameter - k.front()) / (k.back() - k.front());
}

Eigen::Vector3d point_at(const PatchNet& net, const Edge& edge, double s) {
  const Eigen::Vector2d at = on_edge(net.basis, edge, from_unit(net.basis.mesh(), edge, s));
  ShapeValues shape;
  const int cell = net.basis.cell_at(at.x(), at.y());
  net.basis.evaluate(cell, at.x(), at.y(), shape);
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  const auto& functions = net.basis.cells()[std::size_t(cell)].functions;
  for (std::size_t f = 0; f < functions.size(); ++f) r += shape.R(Eigen::Index(f)) * net.point(functions[f]);
  return r;
}

double gap(const PatchNet& a, const Edge& edge_a, const PatchNet& b, const Edge& edge_b, bool reversed) {
  constexpr int pieces = 16;
  double most = 0;
  for (int k = 0; k <= pieces; ++k) {
    const double s = double(k) / pieces;
    most = std::max(most, (point_at(a, edge_a, s) - point_at(b, edge_b, reversed ? 1 - s : s)).norm());
  }
  return most;
}

double size_of(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

// Knots at which a line reaches the edge, from 0 to 1; double knots are listed twice.
std::vector<double> edge_knots(const TMesh& mesh, const Edge& edge, bool reversed) {
  const int along = 1 - edge.direction, border = edge.high ? mesh.edges().lines(edge.direction) - 1 - degree : degree;
  std::vector<double> result;
  for (int line = degree; line < mesh.edges().lines(along) - degree; ++line) {
    if (!mesh.edges().touches(along, line, border)) continue;
    const double s = to_unit(mesh, edge, mesh.knot(along, line));
    result.push_back(reversed ? 1 - s : s);
  }
  if (reversed) std::reverse(result.begin(), result.end());
  return result;
}

// Those of `all` that are not in `others`.
std::vector<double> lacking(const std::vector<double>& all, std::vector<double> others) {
  std::vector<double> result;
  for (double s : all) {
    const auto found =
        std::find_if(others.begin(), others.end(), [&](double o) { return std::abs(o - s) < same_place; });
    if (found == others.end())
      result.push_back(s);
    else
      others.erase(found);
  }
  return result;
}

void require_same_knots(const Multipatch& basis, const Seam& seam) {
  const auto a = edge_knots(basis.patch(seam.a.patch).mesh(), seam.a.edge, false),
             b = edge_knots(basis.patch(seam.b.patch).mesh(), seam.b.edge, seam.reversed);
  std::string found;
  for (const auto& [only, name] : {std::pair{lacking(a, b), &seam.a.name}, std::pair{lacking(b, a), &seam.b.name}})
    if (!only.empty())
      found += fmt::format("{}{:.6g} only on {}", found.empty() ? "" : ", ", fmt::join(only, ", "), *name);
  if (!found.empty())
    throw std::invalid_argument(
        fmt::format("the edges are divided differently; of the knots along {} (0 to 1), {}: divide both sides alike",
                    seam.a.name, found));
}

// One side of a seam, its rows in the order of side a.
struct Side {
  PatchNet net;
  Edge edge;
  EdgeRows rows;

  Side(const Multipatch& basis, const Points& points, const PatchEdge& of, bool reversed)
      : net(net_of(basis, points, of.patch)), edge(of.edge), rows(plate::rows(net.basis, of.edge)) {
    if (!reversed) return;
    std::reverse(rows.edge.begin(), rows.edge.end());
    std::reverse(rows.second.begin(), rows.second.end());
  }
  double weight(std::size_t j) const { return net.basis.weights()(rows.edge[j]); }
  double f(std::size_t j) const {
    const LocalKnots& k = net.basis.anchors()[std::size_t(rows.edge[j])].knots[std::size_t(edge.direction)];
    return net.basis.weights()(rows.second[j]) / (k[4] - k[0]) / weight(j);
  }
  Eigen::Vector3d slope(std::size_t j) const { return f(j) * (net.point(rows.second[j]) - net.point(rows.edge[j])); }
  Eigen::Vector3d normal(double s) const {
    const Tangents t = tangents(net, on_edge(net.basis, edge, from_unit(net.basis.mesh(), edge, s)));
    return t.u.cross(t.v);
  }
};

// The ratio b of seam.hpp.
double speed_ratio(const Side& a, const Side& b, const Seam& seam) {
  constexpr double somewhere = 0.37;  // away from poles at the ends
  if (a.normal(somewhere).dot(b.normal(seam.reversed ? 1 - somewhere : somewhere)) < 0)
    throw std::invalid_argument(fmt::format(
        "the normals of {} and {} point to different sides; swap u and v, or the direction of one, of a patch",
        seam.a.name, seam.b.name));
  double longest = 0, least = 0, most = 0, kink = 0;
  for (std::size_t j = 0; j < a.rows.edge.size(); ++j) longest = std::max(longest, a.slope(j).norm());
  double sum_a = 0, sum_b = 0;
  for (std::size_t j = 0; j < a.rows.edge.size(); ++j) {
    const Eigen::Vector3d to_a = a.slope(j), to_b = b.slope(j);
    if (to_a.norm() < same_place * longest) continue;  // the pole of a sphere
    const double ratio = to_a.norm() / to_b.norm();
    least = sum_a == 0 ? ratio : std::min(least, ratio);
    most = std::max(most, ratio);
    kink = std::max(kink, std::atan2(to_a.cross(to_b).norm(), -to_a.dot(to_b)));
    sum_a += to_a.norm(), sum_b += to_b.norm();
  }
  if (kink > same_across)
    throw std::invalid_argument(fmt::format(
        "lines across the joint have a kink of {:.3g} degrees there; C1 needs them to go on straight, C0 does "
        "not (a hinge)",
        kink * 180 / std::numbers::pi));
  if (most > least * (1 + same_across))
    throw std::invalid_argument(fmt::format(
        "across the joint the patch of {} is stretched {:.4g} times as much as that of {} at one place and {:.4g} "
        "times at another; C1 needs one ratio all along",
        seam.a.name, least, seam.b.name, most));
  return sum_a / sum_b;
}

}  // namespace

Seam find_seam(const Multipatch& basis, const Points& points, PatchEdge a, PatchEdge b, Continuity continuity) {
  const PatchNet net_a = net_of(basis, points, a.patch), net_b = net_of(basis, points, b.patch);
  const double forward = gap(net_a, a.edge, net_b, b.edge, false), backward = gap(net_a, a.edge, net_b, b.edge, true);
  const double open = std::min(forward, backward);
  if (open > same_place * size_of(points))
    throw std::invalid_argument(
        fmt::format("{} and {} do not lie on each other: up to {:.4g} m apart", a.name, b.name, open));
  return {std::move(a), std::move(b), continuity, backward < forward};
}

void join(const Multipatch& basis, const Points& points, const Seam& seam, Elimination& e) {
  require_same_knots(basis, seam);
  const Side a(basis, points, seam.a, false), b(basis, points, seam.b, seam.reversed);
  const std::size_t n = a.rows.edge.size();
  for (std::size_t j = 0; j < n; ++j)
    if (std::abs(a.weight(j) * b.weight(0) - b.weight(j) * a.weight(0)) > same_place * a.weight(j) * b.weight(0))
      throw std::invalid_argument(
          fmt::format("the weights along {} and {} are not in proportion", seam.a.name, seam.b.name));
  for (std::size_t j = 0; j < n; ++j)
    for (int axis = 0; axis < 3; ++axis)
      e.hold({{b.net.component(b.rows.edge[j], axis), 1}, {a.net.component(a.rows.edge[j], axis), -1}});
  if (seam.continuity == Continuity::C0) return;

  const double ratio = speed_ratio(a, b, seam);
  for (std::size_t j = 0; j < n; ++j) {
    const double to_a = a.f(j), to_b = ratio * b.f(j);
    // At corners where four patches meet, one such condition follows from the others, up to the round-off of the
    // reference.
    for (int axis = 0; axis < 3; ++axis)
      e.hold({{a.net.component(a.rows.edge[j], axis), to_a + to_b},
              {a.net.component(a.rows.second[j], axis), -to_a},
              {b.net.component(b.rows.second[j], axis), -to_b}},
             1e1 * same_place);
  }
}

namespace {

// Elements at the edge with one of these knots inside.
void add_elements(const TMesh& mesh, const Edge& edge, const std::vector<double>& knots, std::vector<Box<double>>& to) {
  const auto along = std::size_t(1 - edge.direction), across = std::size_t(edge.direction);
  const double border = edge.high ? mesh.knots(edge.direction).back() : mesh.knots(edge.direction).front();
  for (const Box<int>& element : mesh.elements()) {
    const Box<double> box = mesh.parameters(element);
    if ((edge.high ? box.high : box.low)[across] != border) continue;
    const double low = to_unit(mesh, edge, box.low[along]), high = to_unit(mesh, edge, box.high[along]);
    if (std::any_of(knots.begin(), knots.end(), [&](double s) { return low < s && s < high; })) to.push_back(box);
  }
}

}  // namespace

std::vector<Box<double>> behind(const Seam& seam, const TMesh& mesh_a, const TMesh& mesh_b) {
  const auto a = edge_knots(mesh_a, seam.a.edge, false), b = edge_knots(mesh_b, seam.b.edge, seam.reversed);
  auto only_a = lacking(a, b);
  if (seam.reversed)
    for (double& s : only_a) s = 1 - s;
  std::vector<Box<double>> result;
  add_elements(mesh_a, seam.a.edge, lacking(b, a), result);
  add_elements(mesh_b, seam.b.edge, only_a, result);
  return result;
}

std::vector<Eigen::Vector2d> other_sides(const Multipatch& basis, const Seam& seam, const Eigen::Vector2d& at) {
  std::vector<Eigen::Vector2d> result;
  const int patch = basis.patch_at(at.x());
  for (const auto& [here, there] : {std::pair{&seam.a, &seam.b}, std::pair{&seam.b, &seam.a}}) {
    if (here->patch != patch) continue;
    const TMesh &mesh = basis.patch(patch).mesh(), &other = basis.patch(there->patch).mesh();
    const auto& across = mesh.knots(here->edge.direction);
    if (at(here->edge.direction) != (here->edge.high ? across.back() : across.front())) continue;
    const double s = to_unit(mesh, here->edge, at(1 - here->edge.direction));
    result.push_back(
        on_edge(basis.patch(there->patch), there->edge, from_unit(other, there->edge, seam.reversed ? 1 - s : s)));
  }
  return result;
}

}  // namespace trammel::plate
