// The deformed beam as the equations of motion and their tangent see it; see equations_of_motion.cpp. For any sizes.
#pragma once

#include "beam.hpp"

namespace trammel::beam {

inline double sum_of_products(int n, const double* x, const double* y) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += x[i] * y[i];
  return sum;
}

template <class Sizes>
void AssumedModeBeam::foreshorten(const Sizes& s, const double* b, double* rows) const {
  for (int i = 0; i < s.N; ++i) combine(s.row, s.N, basis_->H_rows(i), b, rows + i * s.row);
}

template <class Sizes>
void AssumedModeBeam::bending_square(const Sizes& s, const double* b, double* y) const {
  if (s.size == 0) {
    std::fill_n(y, int(s.row), 0.0);
    return;
  }
  double by[triangle(most_functions)];
  int m = 0;
  for (int i = 0; i < s.N; ++i) {
    for (int j = 0; j < i; ++j) by[m++] = 2 * b[i] * b[j];
    by[m++] = b[i] * b[i];
  }
  combine(s.row, triangle(s.N), Rows{basis_->H(0), s.row}, by, y);
}

template <class Sizes>
void AssumedModeBeam::deform(const Sizes& s, In q, Deformation& at) const {
  const InertiaBasis& b = *basis_;
  const double *A = q.data() + i_A_, *B = q.data() + i_B_;
  combine_from(b.X0(), s.size, s.n_axial, Rows{b.phi_x(), s.size}, A, at.L);
  combine(s.size, s.N, Rows{b.phi_y(), s.size}, B, at.Y);
  if (s.size == 0) {
    std::fill_n(at.F, int(s.row), 0.0);
  } else {
    foreshorten(s, B, at.p);
    double half_B[most_functions];
    for (int i = 0; i < s.N; ++i) half_B[i] = 0.5 * B[i];
    combine(s.row, s.N, Rows{at.p, s.row}, half_B, at.F);
  }
  for (int k = 0; k < s.size; ++k) at.X[k] = at.L[k] - at.F[k];
}

// P = p Bd: its coefficients, followed by its integrals with Phi_x.
template <class Sizes>
void AssumedModeBeam::shortening_rate(const Sizes& s, const Deformation& at, const double* Bd, double* P) const {
  if (s.size > 0)
    combine(s.row, s.N, Rows{at.p, s.row}, Bd, P);
  else
    std::fill_n(P, int(s.row), 0.0);
}

// int (X, Y) dm
template <class Sizes>
Eigen::Vector2d AssumedModeBeam::first_moment(const Sizes& s, const double* A, const double* B,
                                              const Deformation& at) const {
  const double X = S0_ + sum_of_products(s.n_axial, Sx_.data(), A) - dot(s.size, basis_->one(), at.F);
  return {X, sum_of_products(s.N, Sy_.data(), B)};
}

// hub inertia + (X X) + (Y Y)
template <class Sizes>
double AssumedModeBeam::turning_inertia(const Sizes& s, const double* A, const double* B, const Deformation& at) const {
  const double LL = I0_ + 2 * sum_of_products(s.n_axial, Dx_.data(), A) + mass_ / 2 * sum_of_products(s.n_axial, A, A);
  const double XX = LL - dot(s.size, at.F, at.L) - dot(s.size, at.F, at.X);
  return hub_inertia + XX + mass_ * sum_of_products(s.N, B, B);
}

}  // namespace trammel::beam
