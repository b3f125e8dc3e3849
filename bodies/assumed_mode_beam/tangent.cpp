// The derivative of int J^T alpha dm + K by a, v and q, blended, alpha being the acceleration of the material less gravity:
//
//     alpha_1 = Phi_x A'' - p B'' - w' Y - Bd^T H Bd - 2 w ud_y - w^2 X + b_1,    b = R^T (o'' - gravity)
//     alpha_2 = Phi_y B'' + w' X + 2 w ud_x - w^2 Y + b_2
//
// With k1 = c_m - c_k w^2 and k2 = 2 w c_d + c_k w', the blended derivatives U of alpha by each coordinate are
//
//     theta: (-c_m Y - 2 c_d (ud_y + w X) + c_k b_2,  c_m X + 2 c_d (ud_x - w Y) - c_k b_1)
//     A_j:   (k1 Phi_x, k2 Phi_x)        B_j: (-k2 Phi_y - s,  k1 Phi_y - e)
//     s = H (k1 B + 2 c_d Bd + c_k B''),   e = H (k2 B + 2 w c_k Bd)
//
// and J^T's own derivative by q adds the terms with alpha.
#include <Eigen/Geometry>

#include "beam.hpp"

namespace trammel::beam {

void AssumedModeBeam::add_tangent_of(In q, In v, In a, Blend c, Local& S) const {
  const InertiaBasis& basis = *basis_;
  const int n = basis.size(), r = basis.bending_size(), row = basis.row(), N = transverse_modes;
  const double *B = q.data() + i_B_, *Bd = v.data() + i_B_, *Bdd = a.data() + i_B_, *one = basis.one();
  const double w = omega(v), w_dot = omega(a), k1 = c.c_m - c.c_k * w * w, k2 = 2 * w * c.c_d + c.c_k * w_dot;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(theta(q)).toRotationMatrix();
  Eigen::Vector2d b = -gravity_;
  if (i_o_ >= 0) b += a.segment<2>(i_o_);
  b = R.transpose() * b;

  Deformation at;
  DeformationRate u, u_dot;
  deform(q, at);
  deform_rate(at, v, u);
  deform_rate(at, a, u_dot);
  alignas(64) double a1[InertiaBasis::most], a2[InertiaBasis::most], U1[InertiaBasis::most], U2[InertiaBasis::most];
  for (int k = 0; k < n; ++k) {
    a1[k] = u_dot.x[k] - w_dot * at.Y[k] - 2 * w * u.y[k] - w * w * at.X[k] + b(0) * one[k];
    a2[k] = u_dot.y[k] + w_dot * at.X[k] + 2 * w * u.x[k] - w * w * at.Y[k] + b(1) * one[k];
    U1[k] = -c.c_m * at.Y[k] - 2 * c.c_d * (u.y[k] + w * at.X[k]) + c.c_k * b(1) * one[k];
    U2[k] = c.c_m * at.X[k] + 2 * c.c_d * (u.x[k] - w * at.Y[k]) - c.c_k * b(0) * one[k];
  }
  alignas(64) double s[most_modes * InertiaBasis::most_row], e[most_modes * InertiaBasis::most_row];
  if (r > 0) {
    add_bending_square(-1, Bd, a1);
    double by_s[most_modes], by_e[most_modes];
    for (int i = 0; i < N; ++i) {
      by_s[i] = k1 * B[i] + 2 * c.c_d * Bd[i] + c.c_k * Bdd[i];
      by_e[i] = k2 * B[i] + 2 * w * c.c_k * Bd[i];
    }
    foreshorten(by_s, s);
    foreshorten(by_e, e);
  }

  // Rows A and B by A and B.
  for (int i = 0; i < axial_modes; ++i) S(i_A_ + i, i_A_ + i) += k1 * mass_ / 2 + c.c_k * K1_(i);
  for (int j = 0; j < N; ++j) {
    const int B_j = i_B_ + j;
    S(B_j, B_j) += k1 * mass_ + c.c_k * K2_(j);
    for (int i = 0; i < axial_modes; ++i) {
      S(i_A_ + i, B_j) -= k2 * Mxy_(i, j);
      S(B_j, i_A_ + i) += k2 * Mxy_(i, j);
    }
    if (r == 0) continue;
    const double *p_j = at.p + j * row, *s_j = s + j * row, *e_j = e + j * row;
    for (int i = 0; i < axial_modes; ++i) {
      S(i_A_ + i, B_j) -= s_j[r + i];
      S(B_j, i_A_ + i) -= k1 * p_j[r + i];
    }
    add_products(r, N, at.p, row, s_j, 1, &S(i_B_, B_j));
    add_products(r, N, basis.phi_y_row(0), row, e_j, -1, &S(i_B_, B_j));
    double by_phi_y[most_modes] = {}, H_alpha[most_modes] = {};
    add_products(r, N, basis.phi_y_row(0), row, p_j, k2, by_phi_y);
    add_products(r, j + 1, basis.H(j), row, a1, c.c_k, H_alpha);
    for (int i = 0; i < N; ++i) S(B_j, i_B_ + i) += by_phi_y[i];
    for (int i = 0; i < j; ++i) S(B_j, i_B_ + i) -= H_alpha[i];
    for (int i = 0; i <= j; ++i) S(i_B_ + i, B_j) -= H_alpha[i];
  }
  if (i_theta_ < 0) return;

  // Column theta, and row theta.
  double* column = &S(0, i_theta_);
  S(i_theta_, i_theta_) += c.c_m * hub_inertia + dot(n, at.X, U2) - dot(n, at.Y, U1);
  add_products(n, axial_modes, basis.phi_x(), n, U1, 1, column + i_A_);
  add_products(n, N, basis.phi_y(), n, U2, 1, column + i_B_);
  alignas(64) double with_phi_x[InertiaBasis::most], with_phi_y[InertiaBasis::most];
  for (int k = 0; k < n; ++k) {
    with_phi_x[k] = -k1 * at.Y[k] + k2 * at.X[k] + c.c_k * a2[k];
    with_phi_y[k] = k2 * at.Y[k] + k1 * at.X[k] - c.c_k * a1[k];
  }
  double by_A[most_modes] = {}, by_B[most_modes] = {};
  add_products(n, axial_modes, basis.phi_x(), n, with_phi_x, 1, by_A);
  add_products(n, N, basis.phi_y(), n, with_phi_y, 1, by_B);
  if (r > 0) {
    add_products(r, N, at.p, row, U1, -1, column + i_B_);
    add_products(r, N, s, row, at.Y, 1, by_B);
    add_products(r, N, e, row, at.X, -1, by_B);
    add_products(r, N, at.p, row, a2, -c.c_k, by_B);
  }
  for (int i = 0; i < axial_modes; ++i) S(i_theta_, i_A_ + i) += by_A[i];
  for (int i = 0; i < N; ++i) S(i_theta_, i_B_ + i) += by_B[i];
  if (i_o_ < 0) return;

  // Rows and columns of the origin: R int U dm, and J^T R^T.
  const auto mean = [&](const double* coefficients, int size) { return dot(size, one, coefficients); };
  const auto place = [&](int j, double U_1, double U_2) { S.block<2, 1>(i_o_, j) += R * Eigen::Vector2d(U_1, U_2); };
  const auto place_row = [&](int i, double J_1, double J_2) {
    S.block<1, 2>(i, i_o_) += c.c_m * (R * Eigen::Vector2d(J_1, J_2)).transpose();
  };
  S(i_o_, i_o_) += c.c_m * mass_;
  S(i_o_ + 1, i_o_ + 1) += c.c_m * mass_;
  place(i_theta_, mean(U1, n) - c.c_k * mean(a2, n), mean(U2, n) + c.c_k * mean(a1, n));
  place_row(i_theta_, -mean(at.Y, n), mean(at.X, n));
  for (int i = 0; i < axial_modes; ++i) {
    place(i_A_ + i, k1 * Sx_(i), k2 * Sx_(i));
    place_row(i_A_ + i, Sx_(i), 0);
  }
  for (int j = 0; j < N; ++j) {
    const double s_1 = r > 0 ? mean(s + j * row, r) : 0, e_1 = r > 0 ? mean(e + j * row, r) : 0;
    place(i_B_ + j, -k2 * Sy_(j) - s_1, k1 * Sy_(j) - e_1);
    place_row(i_B_ + j, r > 0 ? -mean(at.p + j * row, r) : 0, Sy_(j));
  }
}

}  // namespace trammel::beam
