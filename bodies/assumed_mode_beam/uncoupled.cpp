// Coupling none: the inertia of the undeformed beam. M is constant, and only gravity and stiffness are left of f.
#include <Eigen/Geometry>

#include "beam.hpp"

namespace trammel::beam {

void AssumedModeBeam::add_uncoupled_mass(Local& M) const {
  for (int i = 0; i < axial_modes; ++i) M(i_A_ + i, i_A_ + i) = mass_ / 2;
  for (int i = 0; i < transverse_modes; ++i) M(i_B_ + i, i_B_ + i) = mass_;
  if (i_theta_ < 0) return;
  M(i_theta_, i_theta_) = hub_inertia + I0_;
  for (int i = 0; i < transverse_modes; ++i) M(i_theta_, i_B_ + i) = M(i_B_ + i, i_theta_) = Dy_(i);
}

void AssumedModeBeam::add_uncoupled_force(In q, Out f) const {
  const auto A = q.segment(i_A_, axial_modes), B = q.segment(i_B_, transverse_modes);
  const Eigen::Vector2d gravity = Eigen::Rotation2Dd(theta(q)).inverse() * gravity_;
  f.segment(i_A_, axial_modes) += gravity(0) * Sx_ - K1_.cwiseProduct(A);
  f.segment(i_B_, transverse_modes) += gravity(1) * Sy_ - K2_.cwiseProduct(B);
  if (i_theta_ >= 0) f(i_theta_) += gravity(1) * (S0_ + Sx_.dot(A)) - gravity(0) * Sy_.dot(B);
}

void AssumedModeBeam::add_uncoupled_tangent(In q, Blend c, Local& S) const {
  const auto A = q.segment(i_A_, axial_modes), B = q.segment(i_B_, transverse_modes);
  const Eigen::Vector2d gravity = Eigen::Rotation2Dd(theta(q)).inverse() * gravity_;
  add_uncoupled_mass(S);
  S *= c.c_m;
  for (int i = 0; i < axial_modes; ++i) S(i_A_ + i, i_A_ + i) += c.c_k * K1_(i);
  for (int i = 0; i < transverse_modes; ++i) S(i_B_ + i, i_B_ + i) += c.c_k * K2_(i);
  if (i_theta_ < 0) return;
  S(i_theta_, i_theta_) += c.c_k * (gravity(0) * (S0_ + Sx_.dot(A)) + gravity(1) * Sy_.dot(B));
  const auto symmetric = [&](int i, double value) {
    S(i_theta_, i) += c.c_k * value;
    S(i, i_theta_) += c.c_k * value;
  };
  for (int i = 0; i < axial_modes; ++i) symmetric(i_A_ + i, -gravity(1) * Sx_(i));
  for (int i = 0; i < transverse_modes; ++i) symmetric(i_B_ + i, gravity(0) * Sy_(i));
}

}  // namespace trammel::beam
