// The motion of the beam's material at the stations of a ShapeTable, in the beam's own axes (x along the undeformed beam):
//
//     X = X0 + Phi_x A - 1/2 B^T H B,   Y = Phi_y B
//
// p_i = (H B)_i is the slope of the foreshortening; without foreshortening H = 0 and nothing of it is evaluated.
// Fixed storage on the stack: no allocation, and a beam can be evaluated by several threads.
#pragma once

#include <algorithm>

#include "kernels.hpp"
#include "shape_table.hpp"

namespace trammel::beam {

inline constexpr int most_modes = 40;
inline constexpr int most_stations = 256;
inline constexpr int outline_stations = 33;  // of a drawn beam

using Row = double[most_stations];

// (H b)_i at all stations.
inline void foreshortening_slope(const ShapeTable& s, int N, const double* b, Row* p) {
  const int n = s.stations();
  for (int i = 0; i < N; ++i) {
    set_scaled(n, b[0], s.H(i, 0), p[i]);
    for (int j = 1; j < N; ++j) add_scaled(n, b[j], s.H(i, j), p[i]);
  }
}

// b^T H b at all stations, by the symmetric half of H.
inline void foreshortening_square(const ShapeTable& s, int N, const double* b, double* square) {
  const int n = s.stations();
  std::fill_n(square, n, 0.0);
  for (int i = 0; i < N; ++i) {
    add_scaled(n, b[i] * b[i], s.H(i, i), square);
    for (int j = 0; j < i; ++j) add_scaled(n, 2 * b[i] * b[j], s.H(i, j), square);
  }
}

// Linear combinations of the shape functions: y = sum_i c_i Phi_i.
inline void combine_axial(const ShapeTable& s, int n_axial, const double* c, double* y) {
  std::fill_n(y, s.stations(), 0.0);
  for (int i = 0; i < n_axial; ++i) add_scaled(s.stations(), c[i], s.phi_x(i), y);
}
inline void combine_transverse(const ShapeTable& s, int N, const double* c, double* y) {
  std::fill_n(y, s.stations(), 0.0);
  for (int i = 0; i < N; ++i) add_scaled(s.stations(), c[i], s.phi_y(i), y);
}

// Positions at the stations, and p where there is foreshortening.
template <bool foreshortening>
void positions(const ShapeTable& s, int n_axial, int N, const double* A, const double* B, Row* p, double* X,
               double* Y) {
  const int n = s.stations();
  combine_axial(s, n_axial, A, X);
  add_scaled(n, 1, s.X0(), X);
  combine_transverse(s, N, B, Y);
  if constexpr (foreshortening) {
    foreshortening_slope(s, N, B, p);
    for (int i = 0; i < N; ++i) add_scaled(n, -0.5 * B[i], p[i], X);
  }
}

}  // namespace trammel::beam
