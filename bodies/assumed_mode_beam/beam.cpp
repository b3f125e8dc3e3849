#include "beam.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <trammel/quadrature.hpp>

namespace trammel::beam {

namespace {

constexpr int outline_points = 33;  // of a drawn beam

}  // namespace

AssumedModeBeam::AssumedModeBeam() {
  velocity = Eigen::Vector2d::Zero();
}

void AssumedModeBeam::check_amplitudes(const char* name, const std::vector<double>& given, int functions) const {
  if (given.empty() || int(given.size()) == functions) return;
  throw ParameterError(
      name, fmt::format("found {} numbers, expected {} (the number of modes, static functions counted) or none",
                        given.size(), functions));
}

void AssumedModeBeam::check_parameters(const World& world) const {
  if (world.space != Space::planar)
    throw ParameterError("type", "assumed_mode_beam is planar; expected \"space\": \"planar\"");
  if (int(hinge.has_value()) + int(clamped.has_value()) + int(free.has_value()) != 1)
    throw ParameterError("mount",
                         "give exactly one of hinge, clamped, free, e.g. \"mount\": {\"hinge\": [0, 0]}; one that is "
                         "included goes by null: {\"hinge\": null, \"free\": [0, 0]}");
  if (coupling == Coupling::none && free)
    throw ParameterError("coupling", "none needs a root that is held; use linear or full with mount free");
  if (clamped && !(torque.is_constant() && torque(0) == 0))
    throw ParameterError("torque", "a clamped beam cannot be driven; use mount hinge");
  if (clamped && angular_velocity != 0) throw ParameterError("angular_velocity", "a clamped beam cannot turn");
  if (!free && velocity.norm() != 0) throw ParameterError("velocity", "only a free root has one; use mount free");
  check_amplitudes("initial.axial", axial, n_axial_);
  check_amplitudes("initial.transverse", transverse, N_);
  check_amplitudes("initial.axial_rate", axial_rate, n_axial_);
  check_amplitudes("initial.transverse_rate", transverse_rate, N_);
  for (const auto& [name, x] : extra_markers) {
    if (!(x >= 0 && x <= length))
      throw ParameterError("markers", fmt::format("\"{}\" is at x = {}, expected 0 to {} (length)", name, x, length));
    if (name == "root" || name == "tip")
      throw ParameterError("markers",
                           fmt::format("\"{}\" exists already, at x = {}", name, name == "root" ? 0.0 : length));
  }
}

void AssumedModeBeam::prepare(const World& world) {
  n_axial_ = axial_modes + (static_axial ? 1 : 0);
  N_ = transverse_modes + (static_transverse ? 2 : 0);
  check_parameters(world);
  gravity_ = world.gravity;
  place_coordinates();
  const Shape shape = functions();
  integrate_inertia(shape);
  integrate_stiffness(shape);
  place_markers(shape);
  const Vec slope_x = Vec::LinSpaced(std::max(33, 4 * N_ + 1), 0, length);
  slopes_ = Mat::NullaryExpr(slope_x.size(), N_,
                             [&](Eigen::Index k, Eigen::Index i) { return shape.slope_y(int(i), slope_x(k)); });
  name_observables();
}

void AssumedModeBeam::place_coordinates() {
  n_ = 0;
  if (free) i_o_ = 0, n_ = 2;
  if (!clamped) i_theta_ = n_++;
  i_A_ = n_;
  i_B_ = i_A_ + n_axial_;
  n_ = i_B_ + N_;
}

Shape AssumedModeBeam::functions() const {
  Shape shape{length, hub_radius, {}, {}, {}, {}};
  for (int i = 1; i <= axial_modes; ++i) shape.axial.emplace_back(i, length);
  for (int i = 1; i <= transverse_modes; ++i) shape.transverse.emplace_back(i, length);
  if (static_axial) shape.static_axial = {static_stretching(length, shape.axial)};
  if (static_transverse) shape.static_transverse = static_bending(length, shape.transverse);
  return shape;
}

void AssumedModeBeam::integrate_inertia(const Shape& shape) {
  const int n_axial = n_axial_, N = N_;
  const double line_density = density * area;
  const Quadrature rule = gauss_legendre(stations_for(std::max(n_axial, N)), 0, length);
  basis_.emplace(shapes_at(shape, rule.x, foreshortens()), line_density * rule.weight);
  const Mat& integrals = basis_->integrals();
  const auto with_x = integrals.middleCols(2, n_axial), with_y = integrals.rightCols(N);
  mass_ = line_density * length;
  S0_ = integrals(0, 1);
  I0_ = integrals(1, 1);
  Sx_ = with_x.row(0);
  Sy_ = with_y.row(0);
  Dx_ = Vec::Zero(padded(n_axial));
  Dx_.head(n_axial) = with_x.row(1);
  Dy_ = Vec::Zero(padded(N));
  Dy_.head(N) = with_y.row(1);
  Mxy_ = Mat::Zero(padded(n_axial), N);
  Mxy_.topRows(n_axial) = with_y.middleRows(2, n_axial);
  Myx_ = Mat::Zero(padded(N), n_axial);
  Myx_.topRows(N) = with_x.bottomRows(N);
}

// Of modes: int_0^L (Phi_x')^2 dx = k^2 L / 2 and int_0^L (Phi_y'')^2 dx = k^4 L, k the wave number.
void AssumedModeBeam::integrate_stiffness(const Shape& shape) {
  const double EA = youngs_modulus * area, EI = youngs_modulus * second_moment;
  K1_.resize(n_axial_), K2_.resize(N_);
  int i = 0;
  for (const AxialMode& mode : shape.axial) K1_(i++) = EA * std::pow(mode.wave_number(), 2) * length / 2;
  for (const auto& function : shape.static_axial) K1_(i++) = EA * function.stiffness;
  i = 0;
  for (const BendingMode& mode : shape.transverse) K2_(i++) = EI * std::pow(mode.wave_number(), 4) * length;
  for (const auto& function : shape.static_transverse) K2_(i++) = EI * function.stiffness;
}

void AssumedModeBeam::place_markers(const Shape& shape) {
  marker_names_ = {"root", "tip"};
  marker_x_.resize(2 + Eigen::Index(extra_markers.size()));
  marker_x_.head<2>() << 0, length;
  for (const auto& [name, x] : extra_markers) {
    marker_x_(Eigen::Index(marker_names_.size())) = x;
    marker_names_.push_back(name);
  }
  marker_shapes_ = shapes_at(shape, marker_x_, foreshortens());
  outline_shapes_ = shapes_at(shape, Vec::LinSpaced(outline_points, 0, length), foreshortens());
}

void AssumedModeBeam::name_observables() {
  observable_names_ = {"angle", "angular_velocity", "tip_axial", "tip_transverse"};
  for (const char* suffix : {"", "_rate"}) {
    for (int i = 1; i <= n_axial_; ++i) observable_names_.push_back(fmt::format("axial{}_{}", suffix, i));
    for (int i = 1; i <= N_; ++i) observable_names_.push_back(fmt::format("transverse{}_{}", suffix, i));
  }
}

void AssumedModeBeam::initial(Out q, Out v) const {
  q.setZero();
  v.setZero();
  if (i_o_ >= 0) q.segment<2>(i_o_) = *free, v.segment<2>(i_o_) = velocity;
  if (i_theta_ >= 0) q(i_theta_) = angle, v(i_theta_) = angular_velocity;
  const auto fill = [](const std::vector<double>& from, int at, Out to) {
    for (std::size_t i = 0; i < from.size(); ++i) to(at + Eigen::Index(i)) = from[i];
  };
  fill(axial, i_A_, q), fill(transverse, i_B_, q);
  fill(axial_rate, i_A_, v), fill(transverse_rate, i_B_, v);
}

Eigen::Vector2d AssumedModeBeam::origin(In q) const {
  if (i_o_ >= 0) return q.segment<2>(i_o_);
  return hinge ? *hinge : *clamped;
}

void AssumedModeBeam::mass(double, In q, Matrix& M) const {
  if (coupling == Coupling::none)
    add_uncoupled_mass(1, M);
  else
    add_coupled_mass(q, M);
}

void AssumedModeBeam::force(double t, In q, In v, Out f) const {
  if (coupling == Coupling::none)
    add_uncoupled_force(q, f);
  else
    add_coupled_force(q, v, f);
  if (i_theta_ >= 0) f(i_theta_) += torque(t);
}

void AssumedModeBeam::mass_and_force(double t, In q, In v, Matrix& M, Out f) const {
  if (coupling == Coupling::none) {
    add_uncoupled_mass(1, M);
    add_uncoupled_force(q, f);
  } else {
    add_coupled_mass_and_force(q, v, M, f);
  }
  if (i_theta_ >= 0) f(i_theta_) += torque(t);
}

void AssumedModeBeam::add_tangent(double, In q, In v, In a, Blend c, Matrix& S) const {
  if (coupling == Coupling::none)
    add_uncoupled_tangent(q, c, S);
  else
    add_coupled_tangent(q, v, a, c, S);
}

Energy AssumedModeBeam::energy(double, In q, In v) const {
  const auto A = q.segment(i_A_, n_axial_), B = q.segment(i_B_, N_);
  Energy e{.elastic = 0.5 * ((K1_.array() * A.array().square()).sum() + (K2_.array() * B.array().square()).sum())};
  Eigen::Vector2d moment;  // int (X, Y) dm
  if (coupling == Coupling::none) {
    e.kinetic = uncoupled_kinetic_energy(v);
    moment << S0_ + Sx_.dot(A), Sy_.dot(B);
  } else {
    Deformation at;
    deform(q, at);
    e.kinetic = coupled_kinetic_energy(q, v, at);
    moment = first_moment(q, at);
  }
  e.potential = -gravity_.dot(mass_ * origin(q) + Eigen::Rotation2Dd(theta(q)) * moment);
  return e;
}

Power AssumedModeBeam::power(double t, In, In v) const {
  return {.supplied = omega(v) * torque(t)};
}

}  // namespace trammel::beam
