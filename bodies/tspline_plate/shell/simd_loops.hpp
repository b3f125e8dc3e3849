// The three inner loops of a cell, on packs of four functions: values at a point, forces of a point, products of all
// points.
#pragma once

#include <trammel/simd.hpp>

namespace trammel::plate {

using simd::Pack, simd::pack, simd::pack_at, simd::total;

// y(k, c) = sum_I shape_k(I) u_c(I), for the rows k = 0..4 of one point and c = 0..2; y is 5 x 3 by rows.
inline void interpolate(int n, const double* shape, const double* u, double* y) {
  for (int k = 0; k < 5; ++k) {
    Pack x{}, y_{}, z{};
    for (int i = 0; i < n; i += pack) {
      const Pack s = pack_at(shape + k * n + i);
      x += s * pack_at(u + i);
      y_ += s * pack_at(u + n + i);
      z += s * pack_at(u + 2 * n + i);
    }
    y[3 * k] = total(x);
    y[3 * k + 1] = total(y_);
    y[3 * k + 2] = total(z);
  }
}

// f_c(I) += sum_k shape_k(I) g(k, c)
inline void distribute(int n, const double* shape, const double* g, double* f) {
  for (int i = 0; i < n; i += pack) {
    Pack x = pack_at(f + i), y = pack_at(f + n + i), z = pack_at(f + 2 * n + i);
    for (int k = 0; k < 5; ++k) {
      const Pack s = pack_at(shape + k * n + i);
      x += g[3 * k] * s;
      y += g[3 * k + 1] * s;
      z += g[3 * k + 2] * s;
    }
    pack_at(f + i) = x, pack_at(f + n + i) = y, pack_at(f + 2 * n + i) = z;
  }
}

// G_p(J) = sum_q H(p, q) shape_q(J) for the five rows of one point.
inline void apply_hessian(int n, const double* H, const double* shape, double* G) {
  for (int j = 0; j < n; j += pack) {
    Pack s[5];
    for (int q = 0; q < 5; ++q) s[q] = pack_at(shape + q * n + j);
    for (int p = 0; p < 5; ++p) {
      const double* h = H + 5 * p;
      pack_at(G + p * n + j) = (h[0] * s[0] + h[1] * s[1]) + (h[2] * s[2] + h[3] * s[3]) + h[4] * s[4];
    }
  }
}

namespace detail {

// One pack of rows I and `packs` packs of columns J of  K(I, J) = sum_r A_r(I) B_r(J), kept in registers over all r.
template <int packs>
inline void product_block(int rows, int n, const double* A, const double* B, double* K) {
  Pack sum[4][packs] = {};
  for (int r = 0; r < rows; ++r) {
    Pack b_r[packs];
    for (int b = 0; b < packs; ++b) b_r[b] = pack_at(B + r * n + pack * b);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < packs; ++b) sum[a][b] += A[r * n + a] * b_r[b];
  }
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < packs; ++b) pack_at(K + a * n + pack * b) = sum[a][b];
}

// Four rows from i on, columns from j on; few packs alone would wait for each other.
inline void product_row(int rows, int n, int i, int j, const double* A, const double* B, double* K) {
  if ((n - j) % 8 == 4 && n - j > 4) {
    product_block<3>(rows, n, A + i, B + j, K + i * n + j);
    j += 12;
  }
  for (; j + 8 <= n; j += 8) product_block<2>(rows, n, A + i, B + j, K + i * n + j);
  if (j < n) product_block<1>(rows, n, A + i, B + j, K + i * n + j);
}

}  // namespace detail

// K(I, J) = sum_r A_r(I) B_r(J) over `rows` rows, all points of a cell at once; by I.
inline void product(int rows, int n, const double* A, const double* B, double* K) {
  for (int i = 0; i < n; i += pack) detail::product_row(rows, n, i, 0, A, B, K);
}
inline void transpose(int n, const double* K, double* transposed) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) transposed[i * n + j] = K[j * n + i];
}
// The same where K is symmetric.
inline void symmetric_product(int rows, int n, const double* A, const double* B, double* K) {
  for (int i = 0; i < n; i += pack) detail::product_row(rows, n, i, i, A, B, K);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) K[i * n + j] = K[j * n + i];
}

}  // namespace trammel::plate
