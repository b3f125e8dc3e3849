// The two inner loops of the beam: linear combinations of rows, and products of rows with a vector.
//
// Row j starts at x + j * stride. Lengths n are multiples of 4 (rows are padded with zeros), so each loop works on packs of
// four numbers with several sums in flight, which a compiler may not arrange by itself without reordering everything else.
#pragma once

#include <algorithm>

namespace trammel::beam {

inline constexpr int pack = 4;
constexpr int padded(int n) {
  return (n + pack - 1) / pack * pack;
}

namespace detail {

using Pack = double [[gnu::vector_size(8 * pack)]];
using AnyPack = double [[gnu::vector_size(8 * pack), gnu::aligned(8), gnu::may_alias]];

inline const AnyPack& at(const double* x) {
  return *reinterpret_cast<const AnyPack*>(x);
}
inline AnyPack& at(double* x) {
  return *reinterpret_cast<AnyPack*>(x);
}
inline double total(const Pack& s) {
  return (s[0] + s[2]) + (s[1] + s[3]);
}
// The totals of four packs.
inline Pack totals(const Pack& s0, const Pack& s1, const Pack& s2, const Pack& s3) {
  const Pack low = __builtin_shufflevector(s0, s1, 0, 4, 2, 6) + __builtin_shufflevector(s0, s1, 1, 5, 3, 7);
  const Pack high = __builtin_shufflevector(s2, s3, 0, 4, 2, 6) + __builtin_shufflevector(s2, s3, 1, 5, 3, 7);
  return __builtin_shufflevector(low, high, 0, 1, 4, 5) + __builtin_shufflevector(low, high, 2, 3, 6, 7);
}

// `packs` packs of y, from all rows. Few packs take two rows at a time, so that enough sums are in flight.
template <int packs, bool add>
inline void combine_packs(int m, const double* x, int stride, const double* c, double* y) {
  constexpr bool two_rows = packs <= 4;
  Pack sum[packs], second[packs] = {};
  for (int p = 0; p < packs; ++p) sum[p] = add ? Pack(at(y + pack * p)) : Pack{};
  int j = 0;
  if constexpr (two_rows)
    for (; j + 2 <= m; j += 2, x += 2 * stride)
      for (int p = 0; p < packs; ++p) {
        sum[p] += c[j] * at(x + pack * p);
        second[p] += c[j + 1] * at(x + stride + pack * p);
      }
  for (; j < m; ++j, x += stride)
    for (int p = 0; p < packs; ++p) sum[p] += c[j] * at(x + pack * p);
  for (int p = 0; p < packs; ++p) at(y + pack * p) = two_rows ? sum[p] + second[p] : sum[p];
}

template <bool add>
inline void combine_rows(int n, int m, const double* x, int stride, const double* c, double* y) {
  int k = 0;
  for (; k + 8 * pack <= n; k += 8 * pack) combine_packs<8, add>(m, x + k, stride, c, y + k);
  if (k + 4 * pack <= n) combine_packs<4, add>(m, x + k, stride, c, y + k), k += 4 * pack;
  if (k + 2 * pack <= n) combine_packs<2, add>(m, x + k, stride, c, y + k), k += 2 * pack;
  if (k < n) combine_packs<1, add>(m, x + k, stride, c, y + k);
}

}  // namespace detail

// y = sum_j c_j x_j  over m rows of length n
inline void combine(int n, int m, const double* x, int stride, const double* c, double* y) {
  detail::combine_rows<false>(n, m, x, stride, c, y);
}
// y += sum_j c_j x_j
inline void add_combination(int n, int m, const double* x, int stride, const double* c, double* y) {
  detail::combine_rows<true>(n, m, x, stride, c, y);
}

// sum x y
inline double dot(int n, const double* x, const double* y) {
  detail::Pack even{}, odd{};
  int k = 0;
  for (; k + 2 * pack <= n; k += 2 * pack) {
    even += detail::at(x + k) * detail::at(y + k);
    odd += detail::at(x + k + pack) * detail::at(y + k + pack);
  }
  if (k < n) even += detail::at(x + k) * detail::at(y + k);
  return detail::total(even + odd);
}

// out_i += scale x_i . y  over m rows; four at a time, the last ones repeated where fewer remain
inline void add_products(int n, int m, const double* x, int stride, const double* y, double scale, double* out) {
  for (int i = 0; i < m; i += 4) {
    const int rows = std::min(4, m - i);
    const double* x0 = x + std::ptrdiff_t(i) * stride;
    const double *x1 = rows > 1 ? x0 + stride : x0, *x2 = rows > 2 ? x1 + stride : x1,
                 *x3 = rows > 3 ? x2 + stride : x2;
    detail::Pack s0{}, s1{}, s2{}, s3{};
    for (int k = 0; k < n; k += pack) {
      const detail::Pack yk = detail::at(y + k);
      s0 += detail::at(x0 + k) * yk;
      s1 += detail::at(x1 + k) * yk;
      s2 += detail::at(x2 + k) * yk;
      s3 += detail::at(x3 + k) * yk;
    }
    const detail::Pack sums = scale * detail::totals(s0, s1, s2, s3);
    if (rows == 4)
      detail::at(out + i) += sums;
    else
      for (int r = 0; r < rows; ++r) out[i + r] += sums[r];
  }
}

}  // namespace trammel::beam
