// Mass and inertia of a rigid body: given as numbers, or from a homogeneous shape.
//
//     box a x b x c      I = m/12 diag(b^2 + c^2, a^2 + c^2, a^2 + b^2)          V = a b c
//     cylinder r, l      I = m/12 (3 r^2 + l^2) across, m r^2/2 about its axis   V = pi r^2 l
//     sphere r           I = 2/5 m r^2                                           V = 4/3 pi r^3
//
// I [kg m^2] about the centre of mass in body axes, m [kg], lengths [m], density [kg/m^3]. A planar body takes I_zz
// alone. Refused: inertia that no distribution of mass has, which is lambda_3 > lambda_1 + lambda_2 among the principal
// moments.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <trammel/types.hpp>

namespace trammel::rigid_body {

struct Inertia {
  double mass = 0;
  Eigen::Matrix3d about_com = Eigen::Matrix3d::Zero();
};

// The scene's parameters.
struct InertiaInput {
  enum class Axis { x, y, z };
  std::optional<double> mass_, density_;
  std::optional<std::vector<double>> inertia_;  // planar: 1; spatial: 3 of the diagonal, or xx, yy, zz, xy, xz, yz
  std::optional<std::vector<double>> box_;      // a, b, c along the body's axes
  std::optional<double> cylinder_radius_, cylinder_length_;
  Axis cylinder_axis_ = Axis::z;
  std::optional<double> sphere_radius_;
};

// Throws ParameterError with the reason.
Inertia inertia_of(const InertiaInput& input, Space space);

}  // namespace trammel::rigid_body
