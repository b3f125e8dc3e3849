// The description of one patch in a scene: its surface, its first mesh, and the conditions and loads at its edges.
#pragma once

#include <optional>

#include <trammel/parameters.hpp>

#include "tspline_plate/mesh/control_net.hpp"
#include "tspline_plate/mesh/t_junction.hpp"

namespace trammel::plate {

struct Patch final : Component {
  enum class Shape { rectangle, ring, cylinder, sphere, points };
  Shape shape = Shape::rectangle;
  Vec3 origin = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::UnitZ(), start = Eigen::Vector3d::UnitX();
  std::optional<Vec3> along_u, along_v;
  std::optional<double> inner_radius, radius, length;
  double from = 0, to = 1.5707963267948966, south = 0, north = 1.5707963267948966;
  std::vector<double> control_points, weights;

  std::string elements = "10x10";
  int elements_u = 0, elements_v = 0;
  std::vector<double> knots_u, knots_v, partial_lines, crossed;
  Closure closure = Closure::both;

  std::string edge_u0 = "free", edge_u1 = "free", edge_v0 = "free", edge_v1 = "free";
  std::string corner_u0v0 = "free", corner_u1v0 = "free", corner_u0v1 = "free", corner_u1v1 = "free";
  TimeFunction moment_u0, moment_u1, moment_v0, moment_v1;
  std::optional<Vec3> force_u0, force_u1, force_v0, force_v1;
  double pressure_u0 = 0, pressure_u1 = 0, pressure_v0 = 0, pressure_v1 = 0;
  Named<Vec3> markers;

  // The parameters of edge k in the order of `edges`, and of corner k in that of `corners`.
  const std::string& edge_condition(std::size_t k) const {
    return *std::array{&edge_u0, &edge_u1, &edge_v0, &edge_v1}[k];
  }
  const std::string& corner_condition(std::size_t k) const {
    return *std::array{&corner_u0v0, &corner_u1v0, &corner_u0v1, &corner_u1v1}[k];
  }
  const TimeFunction& edge_moment(std::size_t k) const {
    return *std::array{&moment_u0, &moment_u1, &moment_v0, &moment_v1}[k];
  }
  bool has_edge_moment(std::size_t k) const;
  Eigen::Vector3d edge_load(std::size_t k, const Eigen::Vector3d& outward) const;  // dead [N/m]
  bool has_edge_load(std::size_t k) const;

  // Throw ParameterError with the parameter's name within the patch.
  void check() const;
  ControlNet net() const;

 private:
  TMesh mesh() const;
  ControlNet net_of_shape(const TMesh& mesh) const;
};

Declaration patch_declaration();

// The first parameter of the patch that is not at its default; "": none.
std::string first_given(const Patch& patch);

void check_elements(const char* name, const std::vector<double>& numbers, std::size_t count);

}  // namespace trammel::plate
