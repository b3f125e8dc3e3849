// The functions of x that the beam's inertia is made of, and the integrals of their products over the mass.
//
// Products of 1, X0 = hub radius + x and the modes Phi_x and Phi_y with one another are numbers, integrated once.
// Products with the foreshortening's functions H_ij = int_0^x Phi_y,i' Phi_y,j' are sums over a basis orthonormal in
// the mass:
//
//     f(x) = sum_k f_k psi_k(x),   int psi_k psi_l dm = delta_kl,   so   int f g dm = sum_k f_k g_k
//
// which holds for any f as long as g is in the span of the H_ij. These N (N + 1) / 2 functions span far fewer
// dimensions to round-off: 6, 15, 22, 29, 76 for N = 3, 5, 7, 9, 30. The cost grows as N^2 times that dimension,
// instead of N^4 with the tensor int H_ij H_lm dm.
#pragma once

#include <vector>

#include "point_shape.hpp"
#include "static_functions.hpp"
#include "vector_loops.hpp"

namespace trammel::beam {

inline constexpr int most_modes = 40;  // of each kind
inline constexpr int most_functions = most_modes + most_static;
// Number of stations for functions of up to N modes: products of four slopes have up to 4 N half waves, which 5.5 N
// points integrate to round-off.
constexpr int stations_for(int N) {
  return (11 * N + 1) / 2 + 4;
}

class InertiaBasis {
 public:
  static constexpr int most = padded(stations_for(most_functions));  // no more dimensions than stations
  static constexpr int most_row = most + padded(most_functions);

  // From values at quadrature stations; weight: those of the rule times the mass per length.
  InertiaBasis(const std::vector<PointShape>& at, const Vec& weight);

  // int f g dm of each two of the functions 1, X0, Phi_x, Phi_y, in this order.
  const Mat& integrals() const { return integrals_; }

  // The coefficients of these functions, size() numbers each, padded. Without foreshortening, size() is 0.
  int size() const { return size_; }
  const double* one() const { return functions_.col(0).data(); }
  const double* X0() const { return functions_.col(1).data(); }
  const double* phi_x() const { return functions_.data() + 2 * size_; }
  const double* phi_y() const { return functions_.data() + (2 + axial_) * size_; }

  // Rows H_ij of length row(): the coefficients, up to size(), and from there on the integrals int Phi_x,a H_ij dm.
  // Only j <= i is kept (N = 9 then fits the first cache): row j of these starts at H(i) + j row(), and H(i + 1)
  // follows.
  int row() const { return row_; }
  const double* H(int i) const { return half_H_.data() + std::ptrdiff_t(i) * (i + 1) / 2 * row_; }
  // All rows H_i1 to H_iN.
  ScatteredRows H_rows(int i) const { return {half_H_.data(), H_offsets_.data() + i * transverse_}; }

 private:
  int axial_, transverse_;
  int size_ = 0, row_ = 0;
  Mat integrals_, functions_, half_H_;
  std::vector<std::ptrdiff_t> H_offsets_;
};

}  // namespace trammel::beam
