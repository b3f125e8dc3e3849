// The beam's mass matrix and forces, couplings full and linear (without foreshortening every loop over p is empty).
//
// In the beam's axes the columns of J are
//     o: R^T,   theta: (-Y, X),   A_i: (Phi_x,i, 0),   B_i: (-p_i, Phi_y,i)
// and every integral over the mass is a product of coefficients in the InertiaBasis.
#include <Eigen/Geometry>

#include "beam.hpp"

namespace trammel::beam {

void AssumedModeBeam::foreshorten(const double* b, double* rows) const {
  const int N = transverse_modes, n = N * basis_->row();
  combine(n, N, basis_->H(0), n, b, rows);
}

// By the symmetric half of H.
void AssumedModeBeam::add_bending_square(double c, const double* b, double* y) const {
  for (int i = 0; i < transverse_modes; ++i) {
    double products[most_modes];
    for (int j = 0; j < i; ++j) products[j] = 2 * c * b[i] * b[j];
    products[i] = c * b[i] * b[i];
    add_combination(basis_->bending_size(), i + 1, basis_->H(i), basis_->row(), products, y);
  }
}

void AssumedModeBeam::deform(In q, Deformation& at) const {
  const InertiaBasis& b = *basis_;
  const int N = transverse_modes;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_;
  std::copy_n(b.X0(), b.size(), at.X);
  add_combination(b.size(), axial_modes, b.phi_x(), b.size(), A, at.X);
  combine(b.size(), N, b.phi_y(), b.size(), B, at.Y);
  if (b.bending_size() == 0) return;
  foreshorten(B, at.p);
  double half_B[most_modes];
  for (int i = 0; i < N; ++i) half_B[i] = -0.5 * B[i];
  add_combination(b.bending_size(), N, at.p, b.row(), half_B, at.X);
}

void AssumedModeBeam::deform_rate(const Deformation& at, In v, DeformationRate& rate) const {
  const InertiaBasis& b = *basis_;
  const int N = transverse_modes;
  const double *Ad = v.data() + i_A_, *Bd = v.data() + i_B_;
  combine(b.size(), axial_modes, b.phi_x(), b.size(), Ad, rate.x);
  combine(b.size(), N, b.phi_y(), b.size(), Bd, rate.y);
  if (b.bending_size() == 0) return;
  double minus_Bd[most_modes];
  for (int i = 0; i < N; ++i) minus_Bd[i] = -Bd[i];
  add_combination(b.bending_size(), N, at.p, b.row(), minus_Bd, rate.x);
}

// M = int J^T J dm, the upper half first.
void AssumedModeBeam::add_mass(In q, Local& M) const {
  const InertiaBasis& b = *basis_;
  const int n = b.size(), r = b.bending_size(), N = transverse_modes;
  Deformation at;
  deform(q, at);

  for (int i = 0; i < axial_modes; ++i) M(i_A_ + i, i_A_ + i) = mass_ / 2;
  for (int i = 0; i < N; ++i) M(i_B_ + i, i_B_ + i) = mass_;
  if (r > 0)
    for (int i = 0; i < N; ++i) {
      const double* p = at.p + i * b.row();
      double* column = &M(0, i_B_ + i);
      add_products(r, i + 1, at.p, b.row(), p, 1, column + i_B_);
      for (int k = 0; k < axial_modes; ++k) column[i_A_ + k] = -p[r + k];
    }

  if (i_theta_ >= 0) {
    double by_A[padded(most_modes)], by_B[most_modes] = {};
    combine(int(Mxy_.rows()), N, Mxy_.data(), int(Mxy_.rows()), q.data() + i_B_, by_A);
    add_products(n, N, b.phi_y(), n, at.X, 1, by_B);
    if (r > 0) add_products(r, N, at.p, b.row(), at.Y, 1, by_B);
    M(i_theta_, i_theta_) = hub_inertia + dot(n, at.X, at.X) + dot(n, at.Y, at.Y);
    for (int i = 0; i < axial_modes; ++i) M(i_theta_, i_A_ + i) = -by_A[i];
    for (int i = 0; i < N; ++i) M(i_theta_, i_B_ + i) = by_B[i];
  }
  if (i_o_ >= 0) add_origin_mass(at, theta(q), M);

  for (int j = 0; j < n_; ++j)
    for (int i = 0; i < j; ++i) M(j, i) = M(i, j);
}

void AssumedModeBeam::add_origin_mass(const Deformation& at, double angle_now, Local& M) const {
  const InertiaBasis& b = *basis_;
  const int r = b.bending_size();
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle_now).toRotationMatrix();
  M(i_o_, i_o_) = M(i_o_ + 1, i_o_ + 1) = mass_;
  M.block<2, 1>(i_o_, i_theta_) = R * Eigen::Vector2d(-dot(b.size(), b.one(), at.Y), dot(b.size(), b.one(), at.X));
  for (int i = 0; i < axial_modes; ++i) M.block<2, 1>(i_o_, i_A_ + i) = R.col(0) * Sx_(i);
  for (int i = 0; i < transverse_modes; ++i) {
    const double P = r > 0 ? dot(r, b.one(), at.p + i * b.row()) : 0;
    M.block<2, 1>(i_o_, i_B_ + i) = R * Eigen::Vector2d(-P, Sy_(i));
  }
}

// f = -int J^T (alpha - gravity) dm - K with the acceleration at v' = 0
//     alpha_1 = -Bd^T H Bd - 2 w ud_y - w^2 X,    alpha_2 = 2 w ud_x - w^2 Y.
void AssumedModeBeam::add_force(In q, In v, Out f) const {
  const InertiaBasis& b = *basis_;
  const int n = b.size(), r = b.bending_size(), N = transverse_modes;
  const double w = omega(v);
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(theta(q)).toRotationMatrix();
  const Eigen::Vector2d gravity = axes.transpose() * gravity_;
  Deformation at;
  deform(q, at);
  DeformationRate rate;
  deform_rate(at, v, rate);

  alignas(64) double a1[InertiaBasis::most], a2[InertiaBasis::most];
  for (int k = 0; k < n; ++k) {
    a1[k] = -2 * w * rate.y[k] - w * w * at.X[k] - gravity(0) * b.one()[k];
    a2[k] = 2 * w * rate.x[k] - w * w * at.Y[k] - gravity(1) * b.one()[k];
  }
  if (r > 0) add_bending_square(-1, v.data() + i_B_, a1);

  double* f_A = f.data() + i_A_;
  double* f_B = f.data() + i_B_;
  add_products(n, axial_modes, b.phi_x(), n, a1, -1, f_A);
  add_products(n, N, b.phi_y(), n, a2, -1, f_B);
  if (r > 0) add_products(r, N, at.p, b.row(), a1, 1, f_B);
  for (int i = 0; i < axial_modes; ++i) f_A[i] -= K1_(i) * q(i_A_ + i);
  for (int i = 0; i < N; ++i) f_B[i] -= K2_(i) * q(i_B_ + i);
  if (i_theta_ >= 0) f(i_theta_) += dot(n, at.Y, a1) - dot(n, at.X, a2);
  if (i_o_ >= 0) f.segment<2>(i_o_) -= axes * Eigen::Vector2d(dot(n, b.one(), a1), dot(n, b.one(), a2));
}

}  // namespace trammel::beam
