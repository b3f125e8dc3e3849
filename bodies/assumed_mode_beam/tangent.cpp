// The derivative of int J^T alpha dm + K by a, v and q, blended, alpha being the acceleration of the material less
// gravity:
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
// and J^T's own derivative by q adds the terms with alpha. Integrals as in equations_of_motion.cpp: (f g) stands for
// int f g dm; those of modes with modes are constants, the others products of coefficients.
#include <Eigen/Geometry>

#include "deformation.hpp"

namespace trammel::beam {

// The terms of the tangent at one point (t, q, v, a).
struct AssumedModeBeam::TangentPoint {
  Blend c;
  double w, w_dot, k1, k2;
  Eigen::Matrix2d R;
  Eigen::Vector2d b, X;  // X: int (X, Y) dm
  const double *A, *B, *Ad, *Bd, *Add, *Bdd;
  Deformation at;
  // Rows as those of F: P = p Bd, p B'', Bd^T H Bd; and s_j, e_j.
  alignas(64) double P[InertiaBasis::most_row], P_dot[InertiaBasis::most_row], D[InertiaBasis::most_row];
  alignas(64) double s[most_functions * InertiaBasis::most_row], e[most_functions * InertiaBasis::most_row];
  // Coefficients of alpha and of -U by theta's first component.
  alignas(64) double a1[InertiaBasis::most], a2[InertiaBasis::most], U1[InertiaBasis::most];
};

template <class Sizes>
void AssumedModeBeam::prepare_tangent(const Sizes& z, In q, TangentPoint& t) const {
  const InertiaBasis& basis = *basis_;
  const Blend c = t.c;
  deform(z, q, t.at);
  bending_square(z, t.Bd, t.D);
  shortening_rate(z, t.at, t.Bd, t.P);
  shortening_rate(z, t.at, t.Bdd, t.P_dot);
  t.X = first_moment(z, t.A, t.B, t.at);
  if (z.size == 0) return;

  double by_s[most_functions], by_e[most_functions];
  for (int i = 0; i < z.N; ++i) {
    by_s[i] = t.k1 * t.B[i] + 2 * c.c_d * t.Bd[i] + c.c_k * t.Bdd[i];
    by_e[i] = t.k2 * t.B[i] + 2 * t.w * c.c_k * t.Bd[i];
  }
  foreshorten(z, by_s, t.s);
  foreshorten(z, by_e, t.e);

  alignas(64) double ud_x[InertiaBasis::most], ud_y[InertiaBasis::most];
  combine(z.size, z.n_axial, Rows{basis.phi_x(), z.size}, t.Ad, ud_x);
  combine(z.size, z.N, Rows{basis.phi_y(), z.size}, t.Bd, ud_y);
  combine(z.size, z.n_axial, Rows{basis.phi_x(), z.size}, t.Add, t.a1);
  combine(z.size, z.N, Rows{basis.phi_y(), z.size}, t.Bdd, t.a2);
  const double *X = t.at.X, *Y = t.at.Y, *one = basis.one();
  const double w = t.w, w_dot = t.w_dot;
  for (int k = 0; k < z.size; ++k) {
    t.a1[k] += -t.P_dot[k] - w_dot * Y[k] - t.D[k] - 2 * w * ud_y[k] - w * w * X[k] + t.b(0) * one[k];
    t.a2[k] += w_dot * X[k] + 2 * w * (ud_x[k] - t.P[k]) - w * w * Y[k] + t.b(1) * one[k];
    t.U1[k] = -c.c_m * Y[k] - 2 * c.c_d * (ud_y[k] + w * X[k]) + c.c_k * t.b(1) * one[k];
  }
}

// The rows of A and B, differentiated by A and B.
template <class Sizes>
void AssumedModeBeam::add_modal_tangent(const Sizes& z, const TangentPoint& t, Matrix& whole) const {
  Matrix S = whole.from(i_A_, i_A_);
  const double *phi_y = basis_->phi_y(), c_k = t.c.c_k;
  for (int i = 0; i < z.n_axial; ++i) S.add(z.A(i), z.A(i), t.k1 * mass_ / 2 + c_k * K1_(i));
  for (int j = 0; j < z.N; ++j) {
    const int B_j = z.B(j);
    S.add(B_j, B_j, t.k1 * mass_ + c_k * K2_(j));
    for (int i = 0; i < z.n_axial; ++i) {
      S.add(z.A(i), B_j, -t.k2 * Mxy_(i, j));
      S.add(B_j, z.A(i), t.k2 * Mxy_(i, j));
    }
    if (z.size == 0) continue;
    const double *p_j = t.at.p + j * z.row, *s_j = t.s + j * z.row, *phi_j = phi_y + j * z.size;
    for (int i = 0; i < z.n_axial; ++i) {
      S.add(z.A(i), B_j, -s_j[z.size + i]);
      S.add(B_j, z.A(i), -t.k1 * p_j[z.size + i]);
    }
    // p_i (k2 Phi_y,j + s_j) - Phi_y,i e_j - c_k H_ij alpha_1
    alignas(64) double sum[InertiaBasis::most];
    double by_p[padded(most_functions)], by_phi[padded(most_functions)], H_alpha[padded(most_functions)];
    for (int k = 0; k < z.size; ++k) sum[k] = t.k2 * phi_j[k] + s_j[k];
    products(z.size, z.N, Rows{t.at.p, z.row}, sum, by_p);
    products(z.size, z.N, Rows{phi_y, z.size}, t.e + j * z.row, by_phi);
    products(z.size, j + 1, Rows{basis_->H(j), z.row}, t.a1, H_alpha);
    for (int i = 0; i < z.N; ++i) S.add(z.B(i), B_j, by_p[i] - by_phi[i]);
    for (int i = 0; i < j; ++i) S.add(B_j, z.B(i), -c_k * H_alpha[i]);
    for (int i = 0; i <= j; ++i) S.add(z.B(i), B_j, -c_k * H_alpha[i]);
  }
}

// The column and the row of theta.
template <class Sizes>
void AssumedModeBeam::add_turning_tangent(const Sizes& z, const TangentPoint& t, Matrix& whole) const {
  Matrix S = whole.from(i_A_, i_A_);
  const Blend c = t.c;
  const double w = t.w, c_a = t.k2 + c.c_k * t.w_dot;
  const auto axial_by = [&](const double* B, double* y) {  // (Phi_y B  Phi_x)
    combine(padded(z.n_axial), z.N, Rows{Mxy_.data(), padded(z.n_axial)}, B, y);
  };
  const auto bending_by = [&](const double* A, double* y) {  // (Phi_x A  Phi_y)
    combine(padded(z.N), z.n_axial, Rows{Myx_.data(), padded(z.N)}, A, y);
  };
  double Y_x[padded(most_functions)], yd_x[padded(most_functions)], ydd_x[padded(most_functions)];
  axial_by(t.B, Y_x), axial_by(t.Bd, yd_x), axial_by(t.Bdd, ydd_x);
  for (int i = 0; i < z.n_axial; ++i) {
    const double X_x = Dx_(i) + mass_ / 2 * t.A[i] - t.at.F[z.size + i], xd_x = mass_ / 2 * t.Ad[i] - t.P[z.size + i];
    S.add(z.A(i), z.theta, -c.c_m * Y_x[i] - 2 * c.c_d * (yd_x[i] + w * X_x) + c.c_k * t.b(1) * Sx_(i));
    S.add(z.theta, z.A(i), -c.c_m * Y_x[i] + c_a * X_x + c.c_k * (ydd_x[i] + 2 * w * xd_x + t.b(1) * Sx_(i)));
  }

  // With (p U1), (s Y) - (e X) - c_k (p alpha_2), and the share of F and its rates in (X Phi_y), (ud_x Phi_y), (alpha_1
  // Phi_y)
  double A_y[padded(most_functions)], Ad_y[padded(most_functions)], Add_y[padded(most_functions)];
  double column[padded(most_functions)] = {}, row[padded(most_functions)] = {};
  bending_by(t.A, A_y), bending_by(t.Ad, Ad_y), bending_by(t.Add, Add_y);
  if (z.size > 0) {
    alignas(64) double in_column[InertiaBasis::most], in_row[InertiaBasis::most];
    for (int k = 0; k < z.size; ++k) {
      in_column[k] = -c.c_m * t.at.F[k] - 2 * c.c_d * t.P[k];
      in_row[k] = -c.c_m * t.at.F[k] + c.c_k * (t.P_dot[k] + t.D[k]);
    }
    double by[padded(most_functions)];
    const auto add = [&](const double* rows, int stride, const double* x, double scale, double* out) {
      products(z.size, z.N, Rows{rows, stride}, x, by);
      for (int i = 0; i < z.N; ++i) out[i] += scale * by[i];
    };
    add(basis_->phi_y(), z.size, in_column, 1, column);
    add(t.at.p, z.row, t.U1, -1, column);
    add(basis_->phi_y(), z.size, in_row, 1, row);
    add(t.s, z.row, t.at.Y, 1, row);
    add(t.e, z.row, t.at.X, -1, row);
    add(t.at.p, z.row, t.a2, -c.c_k, row);
  }
  for (int i = 0; i < z.N; ++i) {
    const double X_y = Dy_(i) + A_y[i], b_y = c.c_k * t.b(0) * Sy_(i);
    S.add(z.B(i), z.theta, column[i] + c.c_m * X_y + 2 * c.c_d * (Ad_y[i] - w * mass_ * t.B[i]) - b_y);
    S.add(z.theta, z.B(i),
          row[i] + c.c_m * X_y - c.c_k * Add_y[i] + mass_ * (c_a * t.B[i] + 2 * c.c_k * w * t.Bd[i]) - b_y);
  }
  double x_xd = -dot(z.size, t.at.X, t.P);  // (X ud_x) + (Y ud_y)
  for (int i = 0; i < z.n_axial; ++i) x_xd += t.Ad[i] * (Dx_(i) + mass_ / 2 * t.A[i] - t.at.F[z.size + i]);
  for (int i = 0; i < z.N; ++i) x_xd += mass_ * t.B[i] * t.Bd[i];
  S.add(z.theta, z.theta, c.c_m * turning_inertia(z, t.A, t.B, t.at) + 2 * c.c_d * x_xd - c.c_k * t.b.dot(t.X));
}

// The rows and columns of the origin: R int U dm, and J^T R^T.
void AssumedModeBeam::add_origin_tangent(const TangentPoint& t, Matrix& S) const {
  const InertiaBasis& basis = *basis_;
  const Blend c = t.c;
  const int n = basis.size(), row = basis.row(), N = N_;
  const auto mean = [&](const double* coefficients) { return n > 0 ? dot(n, basis.one(), coefficients) : 0; };
  const auto sum = [](const Vec& S_, const double* x) { return S_.dot(Eigen::Map<const Vec>(x, S_.size())); };
  const auto place = [&](int j, double U_1, double U_2) {
    const Eigen::Vector2d column = t.R * Eigen::Vector2d(U_1, U_2);
    for (int i = 0; i < 2; ++i) S.add(i_o_ + i, j, column(i));
  };
  const auto place_row = [&](int i, double J_1, double J_2) {
    const Eigen::Vector2d column = c.c_m * t.R * Eigen::Vector2d(J_1, J_2);
    for (int j = 0; j < 2; ++j) S.add(i, i_o_ + j, column(j));
  };
  for (int i = 0; i < 2; ++i) S.add(i_o_ + i, i_o_ + i, c.c_m * mass_);

  const Eigen::Vector2d ud(sum(Sx_, t.Ad) - mean(t.P), sum(Sy_, t.Bd)), turned(-t.X(1), t.X(0));
  const Eigen::Vector2d udd(sum(Sx_, t.Add) - mean(t.P_dot) - mean(t.D), sum(Sy_, t.Bdd)), ud_turned(-ud(1), ud(0));
  const Eigen::Vector2d alpha = udd + t.w_dot * turned + 2 * t.w * ud_turned - t.w * t.w * t.X + mass_ * t.b;
  const double U_1 = -c.c_m * t.X(1) - 2 * c.c_d * (ud(1) + t.w * t.X(0)) + c.c_k * mass_ * t.b(1);
  const double U_2 = c.c_m * t.X(0) + 2 * c.c_d * (ud(0) - t.w * t.X(1)) - c.c_k * mass_ * t.b(0);
  place(i_theta_, U_1 - c.c_k * alpha(1), U_2 + c.c_k * alpha(0));
  place_row(i_theta_, turned(0), turned(1));
  for (int i = 0; i < n_axial_; ++i) {
    place(i_A_ + i, t.k1 * Sx_(i), t.k2 * Sx_(i));
    place_row(i_A_ + i, Sx_(i), 0);
  }
  for (int j = 0; j < N; ++j) {
    place(i_B_ + j, -t.k2 * Sy_(j) - mean(t.s + j * row), t.k1 * Sy_(j) - mean(t.e + j * row));
    place_row(i_B_ + j, -mean(t.at.p + j * row), Sy_(j));
  }
}

void AssumedModeBeam::add_coupled_tangent(In q, In v, In a, Blend c, Matrix& S) const {
  TangentPoint t;
  t.c = c;
  t.w = omega(v), t.w_dot = omega(a);
  t.k1 = c.c_m - c.c_k * t.w * t.w, t.k2 = 2 * t.w * c.c_d + c.c_k * t.w_dot;
  t.R = Eigen::Rotation2Dd(theta(q)).toRotationMatrix();
  t.b = -gravity_;
  if (i_o_ >= 0) t.b += a.segment<2>(i_o_);
  t.b = t.R.transpose() * t.b;
  t.A = q.data() + i_A_, t.B = q.data() + i_B_;
  t.Ad = v.data() + i_A_, t.Bd = v.data() + i_B_;
  t.Add = a.data() + i_A_, t.Bdd = a.data() + i_B_;
  with_known(sizes(), [&](const auto& z) {
    prepare_tangent(z, q, t);
    add_modal_tangent(z, t, S);
    if (i_theta_ >= 0) add_turning_tangent(z, t, S);
  });
  if (i_o_ >= 0) add_origin_tangent(t, S);
}

}  // namespace trammel::beam
