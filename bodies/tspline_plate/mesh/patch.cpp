#include "tspline_plate/mesh/patch.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <fmt/format.h>

namespace trammel::plate {

namespace {

using Vector3 = Eigen::Vector3d;

// With a margin for the round-off of the scene's angles.
constexpr double full_turn = 2 * std::numbers::pi * (1 + 1e-12), to_pole = full_turn / 4;
constexpr double parallel = 1e-9;             // [rad] angle of two axes that counts as none
constexpr double least_independence = 1e-10;  // of functions, from 0 (dependent) to 1
constexpr int most_elements = 1000;           // of the first mesh in each direction

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

// "10x8": the numbers of elements in u and v.
std::array<int, 2> read_elements(const std::string& text) {
  int n = 0, m = 0, used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &n, &m, &used) != 2 || used != int(text.size()) || n < 1 || m < 1 ||
      n > most_elements || m > most_elements)
    throw ParameterError("mesh.elements",
                         fmt::format("found \"{}\", expected two whole numbers such as \"10x10\"", text));
  return {n, m};
}

// Four numbers a line, as in mesh.partial.
std::vector<PartialLine> read_partial_lines(const std::vector<double>& numbers) {
  if (numbers.size() % 4 != 0)
    throw ParameterError("mesh.partial",
                         fmt::format("found {} numbers, expected four a line: 0 (u = const) or 1 (v = const), "
                                     "line, from, to",
                                     numbers.size()));
  std::vector<PartialLine> lines;
  for (std::size_t i = 0; i < numbers.size(); i += 4)
    lines.push_back({numbers[i] != 0 ? 1 : 0, int(numbers[i + 1]), int(numbers[i + 2]), int(numbers[i + 3])});
  return lines;
}

}  // namespace

void check_elements(const char* name, const std::vector<double>& numbers, std::size_t count) {
  for (double e : numbers)
    if (!(e >= 0 && e < double(count) && e == std::floor(e)))
      throw ParameterError(name, fmt::format("no element {}; there are 0 to {}, by rows", e, count - 1));
}

void Patch::check() const {
  const auto need = [](const char* name, bool given, const char* of_shape) {
    if (!given) throw ParameterError(name, fmt::format("geometry {} needs it", of_shape));
  };
  switch (shape) {
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
      if (!(south >= -to_pole && north <= to_pole && north > south && north - south <= largest_arc))
        throw ParameterError(
            "geometry.north",
            fmt::format("found latitudes from {} to {}, expected -pi/2 <= south < north <= pi/2, at most {} "
                        "apart: join two patches for more",
                        south, north, largest_arc));
      break;
    case Shape::points:
      need("geometry.control_points", !control_points.empty(), "points");
      break;
  }
  const bool turns = shape == Shape::ring || shape == Shape::cylinder || shape == Shape::sphere;
  if (turns && !(to > from && to - from <= full_turn))
    throw ParameterError("geometry.to", fmt::format("found {}, expected from < to <= from + 2 pi", to));
  if (Vector3(axis).cross(Vector3(start)).norm() <= parallel * axis.norm() * start.norm())
    throw ParameterError("geometry.start", "must not be parallel to axis");
}

TMesh Patch::mesh() const {
  std::vector<double> u = knots_u, v = knots_v;
  if (u.empty() != v.empty()) throw ParameterError(u.empty() ? "mesh.u" : "mesh.v", "give both u and v, or elements");
  if (u.empty()) {
    const auto [n, m] = read_elements(elements);
    u = even_knots(elements_u > 0 ? elements_u : n), v = even_knots(elements_v > 0 ? elements_v : m);
  }
  if (shape != Shape::points && (u.front() != 0 || u.back() != 1 || v.front() != 0 || v.back() != 1))
    throw ParameterError("mesh.u", "knots of this geometry go from 0 to 1, in u and v");
  const std::vector<PartialLine> partial = read_partial_lines(partial_lines);
  try {
    TMesh result = TMesh::tensor(u, v, partial);
    const auto faces = result.elements();
    check_elements("mesh.cross", crossed, faces.size());
    std::vector<Box<double>> boxes;
    for (double e : crossed) boxes.push_back(result.parameters(faces[std::size_t(e)]));
    refine(result, boxes, closure);
    close(result, closure);  // also closes partial lines where nothing is crossed
    return result;
  } catch (const std::invalid_argument& e) {
    throw ParameterError("mesh", e.what());
  }
}

ControlNet Patch::net_of_shape(const TMesh& mesh) const {
  Frame frame{origin, Eigen::Matrix3d::Identity()};
  frame.axes.col(2) = Vector3(axis).normalized();
  frame.axes.col(1) = Vector3(frame.axes.col(2)).cross(Vector3(start)).normalized();
  frame.axes.col(0) = Vector3(frame.axes.col(1)).cross(Vector3(frame.axes.col(2)));
  switch (shape) {
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

ControlNet Patch::net() const {
  const TMesh first = mesh();
  try {
    if (shape != Shape::points) return refined(net_of_shape(first), first);
    const auto n = Eigen::Index(anchors(first).size());
    if (Eigen::Index(control_points.size()) != 3 * n)
      throw ParameterError("geometry.control_points",
                           fmt::format("found {} numbers, expected {}: x, y, z of {} control points, by rows",
                                       control_points.size(), 3 * n, n));
    ControlNet net{first, Vec::Ones(n), Points(n, 3)};
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index c = 0; c < 3; ++c) net.points(i, c) = control_points[std::size_t(3 * i + c)];
    if (!weights.empty()) net.weights = Eigen::Map<const Vec>(weights.data(), Eigen::Index(weights.size()));
    const TsplineBasis basis(net.mesh, net.weights);
    if (!analysis_suitable(first) && independence(basis) < least_independence)
      throw ParameterError(
          "mesh", "the functions of this T-mesh are not linearly independent; choose the closure both or greedy");
    return net;
  } catch (const std::invalid_argument& e) {
    throw ParameterError(shape == Shape::points ? "geometry.weights" : "mesh", e.what());
  } catch (const std::domain_error& e) {
    throw ParameterError("mesh.closure", e.what());
  }
}

bool Patch::has_edge_moment(std::size_t k) const {
  return !edge_moment(k).is_constant() || edge_moment(k)(0) != 0;
}

bool Patch::has_edge_load(std::size_t k) const {
  return edge_load(k, Vector3::UnitX()) != Vector3::Zero() || edge_load(k, Vector3::UnitY()) != Vector3::Zero();
}

Eigen::Vector3d Patch::edge_load(std::size_t k, const Vector3& outward) const {
  const auto& force_of_edge = *std::array{&force_u0, &force_u1, &force_v0, &force_v1}[k];
  const double pressure_of_edge = std::array{pressure_u0, pressure_u1, pressure_v0, pressure_v1}[k];
  Vector3 result = -pressure_of_edge * outward;
  if (force_of_edge) result += *force_of_edge;
  return result;
}

}  // namespace trammel::plate
