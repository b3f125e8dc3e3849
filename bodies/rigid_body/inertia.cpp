#include "inertia.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <trammel/component.hpp>

namespace trammel::rigid_body {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A flat body lies exactly on the bound of principal moments, and its numbers may be rounded to a few digits.
constexpr double rounded = 1e-6;

// A homogeneous body of density 1.
struct Shape {
  const char* parameter;
  double volume;
  Matrix3d inertia_by_mass;  // I / m
};

std::optional<Shape> box(const InertiaInput& input) {
  if (!input.box_) return {};
  if (input.box_->size() != 3)
    throw ParameterError(
        "box", fmt::format("found {} numbers, expected the 3 lengths along the body's axes", input.box_->size()));
  const Vector3d edge(input.box_->data());
  const Vector3d square = edge.cwiseAbs2();
  return Shape{"box", edge.prod(), (Vector3d::Constant(square.sum()) - square).asDiagonal().toDenseMatrix() / 12};
}

std::optional<Shape> cylinder(const InertiaInput& input) {
  if (!input.cylinder_radius_ && !input.cylinder_length_) return {};
  for (const auto& [name, value] :
       {std::pair{"cylinder.radius", input.cylinder_radius_}, std::pair{"cylinder.length", input.cylinder_length_}})
    if (!value) throw ParameterError(name, "missing; a cylinder has a radius and a length");
  const double r = *input.cylinder_radius_, l = *input.cylinder_length_;
  Vector3d moments = Vector3d::Constant((3 * r * r + l * l) / 12);
  moments(int(input.cylinder_axis_)) = r * r / 2;
  return Shape{"cylinder", std::numbers::pi * r * r * l, moments.asDiagonal()};
}

std::optional<Shape> sphere(const InertiaInput& input) {
  if (!input.sphere_radius_) return {};
  const double r = *input.sphere_radius_;
  return Shape{"sphere", 4 * std::numbers::pi / 3 * r * r * r, 0.4 * r * r * Matrix3d::Identity()};
}

std::optional<Shape> shape_of(const InertiaInput& input) {
  std::optional<Shape> found;
  for (const auto& shape : {box(input), cylinder(input), sphere(input)}) {
    if (!shape) continue;
    if (found)
      throw ParameterError(shape->parameter, fmt::format("give one shape; there is a {} too", found->parameter));
    found = shape;
  }
  return found;
}

Matrix3d tensor(const std::vector<double>& numbers, Space space) {
  Matrix3d I = Matrix3d::Zero();
  if (space == Space::planar) {
    if (numbers.size() != 1)
      throw ParameterError("inertia", fmt::format("found {} numbers, expected 1: the scene is planar", numbers.size()));
    I(2, 2) = numbers[0];
    return I;
  }
  if (numbers.size() != 3 && numbers.size() != 6)
    throw ParameterError("inertia",
                         fmt::format("found {} numbers, expected [xx, yy, zz] or [xx, yy, zz, xy, xz, yz]: the "
                                     "scene is spatial",
                                     numbers.size()));
  I.diagonal() = Vector3d(numbers.data());
  if (numbers.size() == 6) {
    I(0, 1) = I(1, 0) = numbers[3];
    I(0, 2) = I(2, 0) = numbers[4];
    I(1, 2) = I(2, 1) = numbers[5];
  }
  return I;
}

void check_physical(const Matrix3d& I, Space space, const char* parameter) {
  if (space == Space::planar) {
    if (!(I(2, 2) > 0))
      throw ParameterError(parameter, fmt::format("found {} kg m^2, expected an inertia > 0", I(2, 2)));
    return;
  }
  const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(I, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments(0) > 0))
    throw ParameterError(parameter,
                         fmt::format("the least principal moment is {:.6g} kg m^2, expected > 0", moments(0)));
  if (moments(2) > (moments(0) + moments(1)) * (1 + rounded))
    throw ParameterError(parameter,
                         fmt::format("no body has principal moments {:.6g}, {:.6g}, {:.6g} kg m^2: the largest "
                                     "may not exceed the sum of the others",
                                     moments(0), moments(1), moments(2)));
}

}  // namespace

Inertia inertia_of(const InertiaInput& input, Space space) {
  const std::optional<Shape> shape = shape_of(input);
  if (!input.mass_ && !input.density_)
    throw ParameterError("mass", "missing: give mass [kg], or density [kg/m^3] and a shape");
  if (input.mass_ && input.density_) throw ParameterError("density", "give either mass or density, not both");
  if (input.density_ && !shape) throw ParameterError("density", "a density needs a shape: box, cylinder or sphere");
  if (input.inertia_ && shape)
    throw ParameterError("inertia", fmt::format("the {} gives the inertia; remove one of the two", shape->parameter));
  if (!input.inertia_ && !shape)
    throw ParameterError("inertia", "missing: give inertia [kg m^2], or a shape: box, cylinder or sphere");

  Inertia inertia;
  inertia.mass = input.mass_ ? *input.mass_ : *input.density_ * shape->volume;
  inertia.about_com = shape ? Matrix3d(inertia.mass * shape->inertia_by_mass) : tensor(*input.inertia_, space);
  check_physical(inertia.about_com, space, shape ? shape->parameter : "inertia");
  return inertia;
}

}  // namespace trammel::rigid_body
