// The beam's mass matrix and forces, couplings full and linear (without foreshortening, F and p vanish).
//
// In the beam's axes the columns of J are
//     o: R^T,   theta: (-Y, X),   A_i: (Phi_x,i, 0),   B_i: (-p_i, Phi_y,i)
// With L = X0 + Phi_x A, F = 1/2 B^T H B and P = p Bd,
//     X = L - F,   Y = Phi_y B,   ud_x = Phi_x Ad - P,   ud_y = Phi_y Bd.
// Integrals of modes with modes are constants (the modes of a kind are orthogonal), those with F, P or p_i are products
// of coefficients in the InertiaBasis; below, (f g) stands for int f g dm.
#include <Eigen/Geometry>

#include "deformation.hpp"

namespace trammel::beam {

AnySizes AssumedModeBeam::sizes() const {
  return {n_axial_, N_, basis_->size(), basis_->row()};
}

// M = int J^T J dm
template <class Sizes>
void AssumedModeBeam::add_mass(const Sizes& s, In q, const Deformation& at, Matrix& whole) const {
  const InertiaBasis& b = *basis_;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_;
  Matrix M = whole.from(i_A_, i_A_);
  // Column j from row `first` on, and row j as well: in two loops, otherwise the compiler assumes that they overlap.
  const auto symmetric = [&](auto count, int first, int j, const double* values) {
    for (int i = 0; i < count; ++i) M.add(first + i, j, values[i]);
    for (int i = 0; i < count; ++i) M.add(j, first + i, values[i]);
  };
  for (int i = 0; i < s.n_axial; ++i) M.add(s.A(i), s.A(i), mass_ / 2);
  for (int i = 0; i < s.N; ++i) M.add(s.B(i), s.B(i), mass_);
  if (s.size > 0)
    for (int j = 0; j < s.N; ++j) {
      const double* p = at.p + j * s.row;
      double pp[padded(most_functions)];
      products(s.size, j + 1, Rows{at.p, s.row}, p, pp);
      symmetric(j, s.B(0), s.B(j), pp);
      M.add(s.B(j), s.B(j), pp[j]);
      double p_x[padded(most_functions)];
      for (int i = 0; i < s.n_axial; ++i) p_x[i] = -p[s.size + i];
      symmetric(s.n_axial, s.A(0), s.B(j), p_x);
    }
  if (i_theta_ < 0) return;

  // (Y Phi_x),  (X Phi_y) + (Y p),  (X X) + (Y Y)
  double Y_x[padded(most_functions)], L_y[padded(most_functions)], F_y[padded(most_functions)] = {},
                                                                   Y_p[padded(most_functions)] = {};
  combine(padded(s.n_axial), s.N, Rows{Mxy_.data(), padded(s.n_axial)}, B, Y_x);
  combine_from(Dy_.data(), padded(s.N), s.n_axial, Rows{Myx_.data(), padded(s.N)}, A, L_y);
  if (s.size > 0) {
    products(s.size, s.N, Rows{b.phi_y(), s.size}, at.F, F_y);
    products(s.size, s.N, Rows{at.p, s.row}, at.Y, Y_p);
  }
  for (int i = 0; i < s.n_axial; ++i) Y_x[i] = -Y_x[i];
  for (int i = 0; i < s.N; ++i) L_y[i] += Y_p[i] - F_y[i];
  symmetric(s.n_axial, s.A(0), s.theta, Y_x);
  symmetric(s.N, s.B(0), s.theta, L_y);
  M.add(s.theta, s.theta, turning_inertia(s, A, B, at));
  if (i_o_ >= 0) add_origin_mass(q, at, whole);
}

Eigen::Vector2d AssumedModeBeam::first_moment(In q, const Deformation& at) const {
  return first_moment(sizes(), q.data() + i_A_, q.data() + i_B_, at);
}

void AssumedModeBeam::add_origin_mass(In q, const Deformation& at, Matrix& M) const {
  const InertiaBasis& b = *basis_;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(theta(q)).toRotationMatrix();
  const auto add = [&](int j, double J_1, double J_2) {
    const Eigen::Vector2d column = R * Eigen::Vector2d(J_1, J_2);
    for (int i = 0; i < 2; ++i) {
      M.add(i_o_ + i, j, column(i));
      M.add(j, i_o_ + i, column(i));
    }
  };
  M.add(i_o_, i_o_, mass_);
  M.add(i_o_ + 1, i_o_ + 1, mass_);
  const Eigen::Vector2d moment = first_moment(q, at);
  add(i_theta_, -moment(1), moment(0));
  for (int i = 0; i < n_axial_; ++i) add(i_A_ + i, Sx_(i), 0);
  for (int i = 0; i < N_; ++i) add(i_B_ + i, b.size() > 0 ? -dot(b.size(), b.one(), at.p + i * b.row()) : 0, Sy_(i));
}

// f = -int J^T (alpha - gravity) dm - K with the acceleration at v' = 0
//     alpha_1 = -D - 2 w ud_y - w^2 X,   alpha_2 = 2 w ud_x - w^2 Y,   D = Bd^T H Bd
template <class Sizes>
void AssumedModeBeam::add_force(const Sizes& s, In q, In v, const Deformation& at, Out f) const {
  const InertiaBasis& b = *basis_;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_, *Ad = v.data() + i_A_, *Bd = v.data() + i_B_;
  const double w = omega(v);
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(theta(q)).toRotationMatrix();
  const Eigen::Vector2d g = axes.transpose() * gravity_;
  alignas(64) double D[InertiaBasis::most_row], P[InertiaBasis::most_row];
  bending_square(s, Bd, D);
  shortening_rate(s, at, Bd, P);

  // (Phi_x alpha_1) and (Phi_y alpha_2) - (p alpha_1)
  double y_x[padded(most_functions)], x_y[padded(most_functions)], P_y[padded(most_functions)] = {},
                                                                   p_a1[padded(most_functions)] = {};
  combine(padded(s.n_axial), s.N, Rows{Mxy_.data(), padded(s.n_axial)}, Bd, y_x);
  combine(padded(s.N), s.n_axial, Rows{Myx_.data(), padded(s.N)}, Ad, x_y);
  if (s.size > 0) {
    alignas(64) double a1[InertiaBasis::most];
    combine(s.size, s.N, Rows{b.phi_y(), s.size}, Bd, a1);
    for (int k = 0; k < s.size; ++k) a1[k] = -D[k] - 2 * w * a1[k] - w * w * at.X[k] - g(0) * b.one()[k];
    products(s.size, s.N, Rows{at.p, s.row}, a1, p_a1);
    products(s.size, s.N, Rows{b.phi_y(), s.size}, P, P_y);
  }
  const double *F_x = at.F + s.size, *D_x = D + s.size;
  double f_A[most_functions], f_B[most_functions];  // complete before f is written, which might be what is read
  for (int i = 0; i < s.n_axial; ++i)
    f_A[i] = D_x[i] + 2 * w * y_x[i] + w * w * (Dx_(i) + mass_ / 2 * A[i] - F_x[i]) + g(0) * Sx_(i) - K1_(i) * A[i];
  for (int i = 0; i < s.N; ++i)
    f_B[i] = p_a1[i] - 2 * w * (x_y[i] - P_y[i]) + w * w * mass_ * B[i] + g(1) * Sy_(i) - K2_(i) * B[i];
  for (int i = 0; i < s.n_axial; ++i) f(i_A_ + i) += f_A[i];
  for (int i = 0; i < s.N; ++i) f(i_B_ + i) += f_B[i];
  if (i_theta_ < 0) return;

  // (Y alpha_1) - (X alpha_2); here w^2 cancels.
  const Eigen::Vector2d moment = first_moment(s, A, B, at);
  double X_x = -dot(s.size, at.X, P);  // (X ud_x)
  for (int i = 0; i < s.n_axial; ++i) X_x += Ad[i] * (Dx_(i) + mass_ / 2 * A[i] - F_x[i]);
  const double Y_y = mass_ * sum_of_products(s.N, B, Bd);  // (Y ud_y)
  f(i_theta_) += -dot(s.size, at.Y, D) - 2 * w * (X_x + Y_y) + g(1) * moment(0) - g(0) * moment(1);
  if (i_o_ < 0) return;
  double x = -dot(s.size, b.one(), P), y = 0;  // int ud dm
  for (int i = 0; i < s.n_axial; ++i) x += Sx_(i) * Ad[i];
  for (int i = 0; i < s.N; ++i) y += Sy_(i) * Bd[i];
  const double a1 = -dot(s.size, b.one(), D) - 2 * w * y - w * w * moment(0);
  const double a2 = 2 * w * x - w * w * moment(1);
  f.segment<2>(i_o_) += mass_ * gravity_ - axes * Eigen::Vector2d(a1, a2);
}

// 2 T = int |ud + w (-Y, X) + R^T o'|^2 dm + hub inertia w^2
double AssumedModeBeam::coupled_kinetic_energy(In q, In v, const Deformation& at) const {
  const InertiaBasis& b = *basis_;
  const AnySizes s = sizes();
  const auto A = q.segment(i_A_, s.n_axial), B = q.segment(i_B_, s.N), Ad = v.segment(i_A_, s.n_axial),
             Bd = v.segment(i_B_, s.N);
  alignas(64) double P[InertiaBasis::most_row], ud_y[InertiaBasis::most];
  shortening_rate(s, at, Bd.data(), P);
  combine(s.size, s.N, Rows{b.phi_y(), s.size}, Bd.data(), ud_y);
  const auto Mxy = Mxy_.topRows(s.n_axial);
  const double w = omega(v);
  const double xd_xd =
      mass_ / 2 * Ad.squaredNorm() - 2 * sum_of_products(s.n_axial, Ad.data(), P + s.size) + dot(s.size, P, P);
  const double X_yd = Dy_.head(s.N).dot(Bd) + A.dot(Mxy.lazyProduct(Bd)) - dot(s.size, at.F, ud_y);
  const double Y_xd = Ad.dot(Mxy.lazyProduct(B)) - dot(s.size, at.Y, P);
  double twice =
      xd_xd + mass_ * Bd.squaredNorm() + w * w * turning_inertia(s, A.data(), B.data(), at) + 2 * w * (X_yd - Y_xd);
  if (i_o_ >= 0) {
    const Eigen::Vector2d moment = first_moment(q, at), o_dot = v.segment<2>(i_o_);
    const Eigen::Vector2d momentum(Sx_.dot(Ad) - dot(s.size, b.one(), P) - w * moment(1), Sy_.dot(Bd) + w * moment(0));
    twice += mass_ * o_dot.squaredNorm() + 2 * o_dot.dot(Eigen::Rotation2Dd(theta(q)) * momentum);
  }
  return twice / 2;
}

void AssumedModeBeam::deform(In q, Deformation& at) const {
  deform(sizes(), q, at);
}

void AssumedModeBeam::add_coupled_mass(In q, Matrix& M) const {
  with_known(sizes(), [&](const auto& s) {
    Deformation at;
    deform(s, q, at);
    add_mass(s, q, at, M);
  });
}

void AssumedModeBeam::add_coupled_force(In q, In v, Out f) const {
  with_known(sizes(), [&](const auto& s) {
    Deformation at;
    deform(s, q, at);
    add_force(s, q, v, at, f);
  });
}

void AssumedModeBeam::add_coupled_mass_and_force(In q, In v, Matrix& M, Out f) const {
  with_known(sizes(), [&](const auto& s) {
    Deformation at;
    deform(s, q, at);
    add_mass(s, q, at, M);
    add_force(s, q, v, at, f);
  });
}

}  // namespace trammel::beam
