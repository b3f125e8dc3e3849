// The three inner loops of a cell, on packs of four functions: values at a point, forces of a point, products of all points.
#pragma once

namespace trammel::plate {

using Pack = double [[gnu::vector_size(32)]];
using AnyPack = double [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]];

inline const AnyPack& pack(const double* x) {
  return *reinterpret_cast<const AnyPack*>(x);
}
inline AnyPack& pack(double* x) {
  return *reinterpret_cast<AnyPack*>(x);
}

// y(k, c) = sum_I shape_k(I) u_c(I), for the rows k = 0..4 of one point and c = 0..2; y is 5 x 3 by rows.
inline void interpolate(int n, const double* shape, const double* u, double* y) {
  for (int k = 0; k < 5; ++k) {
    Pack x{}, y_{}, z{};
    for (int i = 0; i < n; i += 4) {
      const Pack s = pack(shape + k * n + i);
      x += s * pack(u + i);
      y_ += s * pack(u + n + i);
      z += s * pack(u + 2 * n + i);
    }
    y[3 * k] = (x[0] + x[2]) + (x[1] + x[3]);
    y[3 * k + 1] = (y_[0] + y_[2]) + (y_[1] + y_[3]);
    y[3 * k + 2] = (z[0] + z[2]) + (z[1] + z[3]);
  }
}

// f_c(I) += sum_k shape_k(I) g(k, c)
inline void distribute(int n, const double* shape, const double* g, double* f) {
  for (int i = 0; i < n; i += 4) {
    Pack x = pack(f + i), y = pack(f + n + i), z = pack(f + 2 * n + i);
    for (int k = 0; k < 5; ++k) {
      const Pack s = pack(shape + k * n + i);
      x += g[3 * k] * s;
      y += g[3 * k + 1] * s;
      z += g[3 * k + 2] * s;
    }
    pack(f + i) = x, pack(f + n + i) = y, pack(f + 2 * n + i) = z;
  }
}

// G_p(J) = sum_q H(p, q) shape_q(J) for the five rows of one point.
inline void apply_hessian(int n, const double* H, const double* shape, double* G) {
  for (int p = 0; p < 5; ++p)
    for (int j = 0; j < n; j += 4) {
      Pack sum{};
      for (int q = 0; q < 5; ++q) sum += H[5 * p + q] * pack(shape + q * n + j);
      pack(G + p * n + j) = sum;
    }
}

namespace detail {

// Four rows I and 4 * packs columns J of  K(I, J) = sum_r shape_r(I) G_r(J), kept in registers over all r.
template <int packs>
inline void product_block(int rows, int n, const double* shape, const double* G, double* K) {
  Pack sum[4][packs] = {};
  for (int r = 0; r < rows; ++r) {
    Pack g[packs];
    for (int b = 0; b < packs; ++b) g[b] = pack(G + r * n + 4 * b);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < packs; ++b) sum[a][b] += shape[r * n + a] * g[b];
  }
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < packs; ++b) pack(K + a * n + 4 * b) = sum[a][b];
}

}  // namespace detail

// K(I, J) = sum_r shape_r(I) G_r(J) over `rows` rows, all points of a cell at once.
inline void product(int rows, int n, const double* shape, const double* G, double* K) {
  for (int i = 0; i < n; i += 4) {
    int j = 0;
    for (; j + 8 <= n; j += 8) detail::product_block<2>(rows, n, shape + i, G + j, K + i * n + j);
    if (j < n) detail::product_block<1>(rows, n, shape + i, G + j, K + i * n + j);
  }
}

}  // namespace trammel::plate
