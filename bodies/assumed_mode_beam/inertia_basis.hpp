// All functions of x that the beam's inertia is made of, as coefficients in a basis orthonormal in the mass:
//
//     f(x) = sum_k f_k psi_k(x),   int psi_k psi_l dm = delta_kl,   so   int f g dm = sum_k f_k g_k.
//
// The functions are 1, X0 = hub radius + x, the modes Phi_x and Phi_y, and H_ij. The N (N + 1) / 2 functions H_ij span far
// fewer dimensions to round-off: 6, 15, 22, 29, 76 for N = 3, 5, 7, 9, 30. They come first in the basis, so that sums with H
// are that short. Against Gauss quadrature (5.5 N stations) this saves a factor of 2 to 3, against the tensor
// int H_ij H_lm dm (N^4 numbers) more, and it grows as N^2 times that dimension.
#pragma once

#include <vector>

#include "point_shape.hpp"
#include "vector_loops.hpp"

namespace trammel::beam {

inline constexpr int most_modes = 40;  // of each kind
// Stations for functions with up to N modes a factor: integrals of four slopes have 4 N half waves, and 5.5 N points give
// them to round-off.
constexpr int stations_for(int N) {
  return (11 * N + 1) / 2 + 4;
}

class InertiaBasis {
 public:
  static constexpr int most = padded(stations_for(most_modes)) + pack;  // no more dimensions than stations
  static constexpr int most_row = most + padded(most_modes);

  // From values at quadrature stations; weight: those of the rule times the mass per length.
  InertiaBasis(const std::vector<PointShape>& at, const Vec& weight);

  int size() const { return size_; }  // of 1, X0, Phi_x, Phi_y; padded
  const double* one() const { return functions_.col(0).data(); }
  const double* X0() const { return functions_.col(1).data(); }  // the phi_x follow it
  const double* phi_x() const { return functions_.data() + 2 * size_; }
  const double* phi_y() const { return functions_.data() + (2 + axial_) * size_; }

  // Rows H_i1, H_i2, ... of length row(): the coefficients, up to bending_size(), and from there on the products
  // int Phi_x,a H_ij dm. Row j of H_i starts at H(i) + j row(). bending_size() is 0 without foreshortening.
  int bending_size() const { return bending_size_; }
  int row() const { return row_; }
  const double* H(int i) const { return H_.data() + std::ptrdiff_t(i) * transverse_ * row_; }
  // Phi_y,j cut to the shape of such a row: the leading coefficients, and int Phi_x,a Phi_y,j dm.
  const double* phi_y_row(int j) const { return phi_y_rows_.col(j).data(); }

 private:
  int axial_, transverse_;
  int size_ = 0, bending_size_ = 0, row_ = 0;
  Mat functions_, H_, phi_y_rows_;
};

}  // namespace trammel::beam
