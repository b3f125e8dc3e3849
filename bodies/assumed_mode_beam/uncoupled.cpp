// Coupling none: the inertia of the undeformed beam. M is constant, and f has only gravity and stiffness.
#include <Eigen/Geometry>

#include "beam.hpp"

namespace trammel::beam {

void AssumedModeBeam::add_uncoupled_mass(double c, Matrix& M) const {
  for (int i = 0; i < n_axial_; ++i) M.add(i_A_ + i, i_A_ + i, c * mass_ / 2);
  for (int i = 0; i < N_; ++i) M.add(i_B_ + i, i_B_ + i, c * mass_);
  if (i_theta_ < 0) return;
  M.add(i_theta_, i_theta_, c * (hub_inertia + I0_));
  for (int i = 0; i < N_; ++i) {
    M.add(i_theta_, i_B_ + i, c * Dy_(i));
    M.add(i_B_ + i, i_theta_, c * Dy_(i));
  }
}

double AssumedModeBeam::uncoupled_kinetic_energy(In v) const {
  const auto Ad = v.segment(i_A_, n_axial_), Bd = v.segment(i_B_, N_);
  const double w = omega(v), turning = (hub_inertia + I0_) * w + 2 * Dy_.head(N_).dot(Bd);
  return 0.5 * (mass_ / 2 * Ad.squaredNorm() + mass_ * Bd.squaredNorm() + w * turning);
}

void AssumedModeBeam::add_uncoupled_force(In q, Out f) const {
  const auto A = q.segment(i_A_, n_axial_), B = q.segment(i_B_, N_);
  const Eigen::Vector2d gravity = Eigen::Rotation2Dd(theta(q)).inverse() * gravity_;
  f.segment(i_A_, n_axial_) += gravity(0) * Sx_ - K1_.cwiseProduct(A);
  f.segment(i_B_, N_) += gravity(1) * Sy_ - K2_.cwiseProduct(B);
  if (i_theta_ >= 0) f(i_theta_) += gravity(1) * (S0_ + Sx_.dot(A)) - gravity(0) * Sy_.dot(B);
}

void AssumedModeBeam::add_uncoupled_tangent(In q, Blend c, Matrix& S) const {
  const auto A = q.segment(i_A_, n_axial_), B = q.segment(i_B_, N_);
  const Eigen::Vector2d gravity = Eigen::Rotation2Dd(theta(q)).inverse() * gravity_;
  add_uncoupled_mass(c.c_m, S);
  for (int i = 0; i < n_axial_; ++i) S.add(i_A_ + i, i_A_ + i, c.c_k * K1_(i));
  for (int i = 0; i < N_; ++i) S.add(i_B_ + i, i_B_ + i, c.c_k * K2_(i));
  if (i_theta_ < 0) return;
  S.add(i_theta_, i_theta_, c.c_k * (gravity(0) * (S0_ + Sx_.dot(A)) + gravity(1) * Sy_.dot(B)));
  const auto symmetric = [&](int i, double value) {
    S.add(i_theta_, i, c.c_k * value);
    S.add(i, i_theta_, c.c_k * value);
  };
  for (int i = 0; i < n_axial_; ++i) symmetric(i_A_ + i, -gravity(1) * Sx_(i));
  for (int i = 0; i < N_; ++i) symmetric(i_B_ + i, gravity(0) * Sy_(i));
}

}  // namespace trammel::beam
