#include "plate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

namespace trammel::plate {

namespace {

struct Corner {
  const char* name;
  int u_edge, v_edge;  // of `edges`
};
constexpr Corner corners[4] = {{"u0v0", 0, 2}, {"u1v0", 1, 2}, {"u0v1", 0, 3}, {"u1v1", 1, 3}};

// The control point of a corner, which the surface passes through.
int corner_anchor(const TsplineBasis& basis, const Corner& corner) {
  const auto u = rows(basis, edges[corner.u_edge]).edge, v = rows(basis, edges[corner.v_edge]).edge;
  for (int i : u)
    if (std::find(v.begin(), v.end(), i) != v.end()) return i;
  throw std::logic_error("a patch without corners");
}

void check_elements(const char* name, const std::vector<double>& numbers, const TMesh& mesh) {
  const std::size_t count = mesh.elements().size();
  for (double e : numbers)
    if (!(e >= 0 && e < double(count) && e == std::floor(e)))
      throw ParameterError(name, fmt::format("no element {}; there are 0 to {}, by rows", e, count - 1));
}

constexpr double full_turn = 2 * 3.141592653589793 * (1 + 1e-12);

// Knots of the lines of direction d that run all across, each once.
std::vector<double> full_lines(const TMesh& mesh, int d) {
  std::vector<double> knots;
  for (int line = degree; line < mesh.edges().lines(d) - degree; ++line) {
    bool full = knots.empty() || mesh.knot(d, line) > knots.back();
    for (int piece = 0; full && piece < mesh.edges().lines(1 - d) - 1; ++piece)
      full = mesh.edges().edge(d, line, piece);
    if (full) knots.push_back(mesh.knot(d, line));
  }
  return knots;
}

std::vector<double> even_knots(int n) {
  std::vector<double> knots;
  for (int i = 0; i <= n; ++i) knots.push_back(double(i) / n);
  return knots;
}

}  // namespace

void TsplinePlate::check_parameters(const World& world) const {
  if (world.space != Space::spatial)
    throw ParameterError("type", "tspline_plate moves in space; set \"space\": \"spatial\"");
  const auto need = [](const char* name, bool given, const char* shape) {
    if (!given) throw ParameterError(name, fmt::format("geometry {} needs it", shape));
  };
  switch (shape_kind) {
    case Shape::rectangle:
      need("geometry.along_u", along_u.has_value(), "rectangle"),
          need("geometry.along_v", along_v.has_value(), "rectangle");
      break;
    case Shape::ring:
      need("geometry.inner_radius", inner_radius.has_value(), "ring"),
          need("geometry.radius", radius.has_value(), "ring");
      if (!(*inner_radius < *radius))
        throw ParameterError("geometry.inner_radius",
                             fmt::format("found {}, expected less than radius, {}", *inner_radius, *radius));
      break;
    case Shape::cylinder:
      need("geometry.radius", radius.has_value(), "cylinder"), need("geometry.length", length.has_value(), "cylinder");
      break;
    case Shape::sphere:
      need("geometry.radius", radius.has_value(), "sphere");
      if (!(north > south && north - south <= largest_arc))
        throw ParameterError("geometry.north",
                             fmt::format("found {}, expected south < north <= south + {}", north, largest_arc));
      break;
    case Shape::points:
      need("geometry.control_points", !control_points.empty(), "points");
      break;
  }
  const bool turns = shape_kind == Shape::ring || shape_kind == Shape::cylinder || shape_kind == Shape::sphere;
  if (turns && !(to > from && to - from <= full_turn))
    throw ParameterError("geometry.to", fmt::format("found {}, expected from < to <= from + 2 pi", to));
  if (Vector3(axis).cross(Vector3(start)).norm() <= 1e-9 * axis.norm() * start.norm())
    throw ParameterError("geometry.start", "must not be parallel to axis");
  if (!held_axes.empty() && axes_in(held_axes).empty())
    throw ParameterError("held_axes", fmt::format("found \"{}\", expected axes such as \"z\" or \"xy\"", held_axes));
  const bool u_held = edge_u0 != "free" || edge_u1 != "free", v_held = edge_v0 != "free" || edge_v1 != "free";
  if ((joined == Joined::u && u_held) || (joined == Joined::v && v_held))
    throw ParameterError("joined", "edges that are joined to each other must be free");
  check_refinement();
}

void TsplinePlate::check_refinement() const {
  const bool on_contact = !refine_on.empty(), by_indicator = indicator != Indicator::none;
  if (on_contact + refine_at.has_value() + by_indicator > 1)
    throw ParameterError(refine_at ? "refine.at" : "refine.indicator", "give one of on_contact, at, indicator");
  if (by_indicator && !refine_threshold)
    throw ParameterError("refine.threshold", "an indicator needs the value above which an element is split");
  if (refine_near && !on_contact) throw ParameterError("refine.near", "it belongs to refine.on_contact");
  if (!refine_elements.empty() && chooses_elements())
    throw ParameterError("refine.elements", "the elements are chosen by near or by the indicator; leave them out");
  if ((on_contact || refine_at) && refine_elements.empty() && !refine_near)
    throw ParameterError("refine.elements", "name the elements to split, counted by rows from 0");
}

TMesh TsplinePlate::first_mesh() const {
  std::vector<double> u = knots_u, v = knots_v;
  if (u.empty() != v.empty()) throw ParameterError(u.empty() ? "mesh.u" : "mesh.v", "give both u and v, or elements");
  if (u.empty()) {
    int n = 0, m = 0, used = 0;
    if (std::sscanf(elements.c_str(), "%dx%d%n", &n, &m, &used) != 2 || used != int(elements.size()) || n < 1 ||
        m < 1 || n > 1000 || m > 1000)
      throw ParameterError("mesh.elements",
                           fmt::format("found \"{}\", expected two whole numbers such as \"10x10\"", elements));
    u = even_knots(elements_u > 0 ? elements_u : n), v = even_knots(elements_v > 0 ? elements_v : m);
  }
  if (shape_kind != Shape::points && (u.front() != 0 || u.back() != 1 || v.front() != 0 || v.back() != 1))
    throw ParameterError("mesh.u", "knots of this geometry go from 0 to 1, in u and v");
  if (partial_lines.size() % 4 != 0)
    throw ParameterError("mesh.partial",
                         fmt::format("found {} numbers, expected four a line: 0 (u = const) or 1 (v = const), "
                                     "line, from, to",
                                     partial_lines.size()));
  std::vector<PartialLine> partial;
  for (std::size_t i = 0; i < partial_lines.size(); i += 4)
    partial.push_back({partial_lines[i] != 0 ? 1 : 0, int(partial_lines[i + 1]), int(partial_lines[i + 2]),
                       int(partial_lines[i + 3])});
  try {
    TMesh mesh = TMesh::tensor(u, v, partial);
    check_elements("mesh.cross", crossed, mesh);
    const auto faces = mesh.elements();
    std::vector<Box<double>> boxes;
    for (double e : crossed) boxes.push_back(mesh.parameters(faces[std::size_t(e)]));
    plate::refine(mesh, boxes, closure);
    close(mesh, closure);  // of partial lines, where nothing was crossed
    check_elements("refine.elements", refine_elements, mesh);
    return mesh;
  } catch (const std::invalid_argument& e) {
    throw ParameterError("mesh", e.what());
  }
}

ControlNet TsplinePlate::net_of_shape(const TMesh& mesh) const {
  Frame frame{origin, Matrix3::Identity()};
  frame.axes.col(2) = Vector3(axis).normalized();
  frame.axes.col(1) = Vector3(frame.axes.col(2)).cross(Vector3(start)).normalized();
  frame.axes.col(0) = Vector3(frame.axes.col(1)).cross(Vector3(frame.axes.col(2)));
  switch (shape_kind) {
    case Shape::ring:
      return ring(frame, *inner_radius, *radius, from, to, full_lines(mesh, 1));
    case Shape::cylinder:
      return cylinder(frame, *radius, *length, from, to, full_lines(mesh, 0));
    case Shape::sphere:
      return sphere(frame, *radius, from, to, south, north, full_lines(mesh, 0));
    default:
      return rectangle(origin, *along_u, *along_v);
  }
}

ControlNet TsplinePlate::first_net() const {
  const TMesh mesh = first_mesh();
  try {
    if (shape_kind != Shape::points) return refined(net_of_shape(mesh), mesh);
    const auto n = Eigen::Index(anchors(mesh).size());
    if (Eigen::Index(control_points.size()) != 3 * n)
      throw ParameterError("geometry.control_points",
                           fmt::format("found {} numbers, expected {}: x, y, z of {} control points, by rows",
                                       control_points.size(), 3 * n, n));
    ControlNet net{mesh, Vec::Ones(n), Points(n, 3)};
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index c = 0; c < 3; ++c) net.points(i, c) = control_points[std::size_t(3 * i + c)];
    if (!weights.empty()) net.weights = Eigen::Map<const Vec>(weights.data(), Eigen::Index(weights.size()));
    const TsplineBasis basis(net.mesh, net.weights);
    if (!analysis_suitable(mesh) && independence(basis) < 1e-10)
      throw ParameterError(
          "mesh", "the functions of this T-mesh are not linearly independent; choose the closure both or greedy");
    return net;
  } catch (const std::invalid_argument& e) {
    throw ParameterError(shape_kind == Shape::points ? "geometry.weights" : "mesh", e.what());
  } catch (const std::domain_error& e) {
    throw ParameterError("mesh.closure", e.what());
  }
}

void TsplinePlate::take(ControlNet net) {
  const PlateData data{{thickness, youngs_modulus, poissons_ratio}, density, quadrature};
  mesh_ = std::make_unique<Discretisation>(std::move(net), data, [this](const Discretisation& d, Elimination& e) {
    for (int axis_held : axes_in(held_axes))
      for (int i = 0; i < d.basis.size(); ++i) e.hold(3 * i + axis_held);
    try {
      if (joined != Joined::none) join_ends(d.basis, d.points, joined == Joined::u ? 0 : 1, e);
    } catch (const std::invalid_argument& error) {
      throw ParameterError("joined", error.what());
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const std::string& condition = corner_condition(k);
      if (condition == "free") continue;
      const auto axes = condition == "hinged" ? std::vector<int>{0, 1, 2} : axes_in(condition);
      if (axes.empty())
        throw ParameterError(fmt::format("corners.{}", corners[k].name),
                             fmt::format("found \"{}\", expected free, hinged or held axes such as \"z\"", condition));
      for (int a : axes) e.hold(3 * corner_anchor(d.basis, corners[k]) + a);
    }
    for (std::size_t k = 0; k < 4; ++k) try {
        hold_edge(d.basis, d.points, edges[k], edge_condition(k), e);
      } catch (const std::invalid_argument& error) {
        throw ParameterError(fmt::format("edges.{}", edge_names[k]), error.what());
      }
  });
  for (std::size_t k = 0; k < 4; ++k) {
    const bool no_moment = edge_moment(k).is_constant() && edge_moment(k)(0) == 0;
    edge_points_[k] = no_moment ? std::vector<EdgePoint>{} : edge_points(*mesh_, edges[k]);
  }
  gather_dead_loads();
  place_markers();
  if (chooses_elements()) splittable_ = Splittable(mesh_->basis, first_elements_, refine_levels);
}

bool TsplinePlate::has_edge_load(std::size_t k) const {
  return edge_load(k, Vector3::UnitX()) != Vector3::Zero() || edge_load(k, Vector3::UnitY()) != Vector3::Zero();
}

Vector3 TsplinePlate::edge_load(std::size_t k, const Vector3& outward) const {
  const auto& force_of_edge = *std::array{&force_u0, &force_u1, &force_v0, &force_v1}[k];
  const double pressure_of_edge = std::array{pressure_u0, pressure_u1, pressure_v0, pressure_v1}[k];
  Vector3 result = -pressure_of_edge * outward;
  if (force_of_edge) result += *force_of_edge;
  return result;
}

void TsplinePlate::gather_dead_loads() {
  const int n = mesh_->basis.size();
  Vec on_weight(3 * n), on_dead(3 * n);
  for (int i = 0; i < n; ++i) {
    on_weight.segment<3>(3 * i) = mesh_->lumped(i) * gravity_;
    on_dead.segment<3>(3 * i) = mesh_->area(i) * Vector3(load);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (!has_edge_load(k)) continue;
    for (const EdgePoint& p : edge_points(*mesh_, edges[k])) {
      const Vector3 line_load = edge_load(k, p.outward);
      const auto& nodes = mesh_->cells[std::size_t(p.point.cell)].nodes;
      for (std::size_t f = 0; f < nodes.size(); ++f)
        on_dead.segment<3>(3 * nodes[f]) += p.length * p.point.shape.R(Eigen::Index(f)) * line_load;
    }
  }
  weight_force_ = dead_force_ = Vec::Zero(mesh_->coordinates.coordinates());
  mesh_->coordinates.restrict(on_weight, weight_force_);
  mesh_->coordinates.restrict(on_dead, dead_force_);
}

void TsplinePlate::place_markers() {
  for (Marker& m : marker_points_) m.point = surface_point(*mesh_, m.u, m.v, m.height);
}

void TsplinePlate::prepare(const World& world) {
  check_parameters(world);
  gravity_ = world.gravity;
  ControlNet net = first_net();
  first_elements_ = element_boxes(net.mesh);
  const auto &u = net.mesh.knots(0), &v = net.mesh.knots(1);
  marker_names_ = {"centre"};
  marker_points_ = {{(u.front() + u.back()) / 2, (v.front() + v.back()) / 2, 0, {}}};
  for (const Corner& c : corners) {
    marker_names_.push_back(c.name);
    marker_points_.push_back(
        {edges[c.u_edge].high ? u.back() : u.front(), edges[c.v_edge].high ? v.back() : v.front(), 0, {}});
  }
  for (const auto& [name, at] : extra_markers) {
    if (!(at(0) >= u.front() && at(0) <= u.back() && at(1) >= v.front() && at(1) <= v.back()))
      throw ParameterError(
          "markers", fmt::format("\"{}\" is at (u, v) = ({}, {}), expected u from {} to {}, v from {} to {}", name,
                                 at(0), at(1), u.front(), u.back(), v.front(), v.back()));
    if (std::find(marker_names_.begin(), marker_names_.end(), name) != marker_names_.end())
      throw ParameterError("markers", fmt::format("\"{}\" exists already", name));
    marker_names_.push_back(name);
    marker_points_.push_back({at(0), at(1), at(2), {}});
  }
  observable_names_ = {"von_mises_top",   "von_mises_middle", "von_mises_bottom",
                       "energy_membrane", "energy_bending",   "elements"};
  for (const std::string& name : marker_names_)
    for (const char* face : {"top", "middle", "bottom"})
      observable_names_.push_back(fmt::format("von_mises_{}_{}", face, name));
  try {
    take(std::move(net));
  } catch (const std::invalid_argument& e) {
    throw ParameterError("geometry", e.what());
  }
}

void TsplinePlate::initial(Out q, Out v) const {
  q.setZero();
  const auto& kept = mesh_->coordinates.kept();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Vector3 arm = Vector3(mesh_->points.row(kept[k] / 3)) - Vector3(origin);
    v(Eigen::Index(k)) = (Vector3(velocity) + Vector3(angular_velocity).cross(arm))(kept[k] % 3);
  }
}

}  // namespace trammel::plate
