// The two inner loops of the beam: linear combinations of rows, and products of rows with a vector.
//
// Row j is rows[j]: at even distances (Rows) or anywhere (ScatteredRows). Lengths n are multiples of 4 (rows are padded
// with zeros), so each loop works on packs of four numbers with several sums in flight, which a compiler may not
// arrange by itself without reordering other operations. Lengths and numbers of rows are int, or Fixed where they are
// known to the compiler, which then unrolls the loops.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include <trammel/simd.hpp>

namespace trammel::beam {

template <int n>
using Fixed = std::integral_constant<int, n>;

using simd::pack, simd::Pack, simd::pack_at, simd::padded, simd::total;

template <int n>
constexpr Fixed<padded(n)> padded(Fixed<n>) {
  return {};
}
constexpr int triangle(int n) {
  return n * (n + 1) / 2;
}
template <int n>
constexpr Fixed<triangle(n)> triangle(Fixed<n>) {
  return {};
}

struct Rows {
  const double* first;
  int stride;
  const double* operator[](int j) const { return first + std::ptrdiff_t(j) * stride; }
};
struct ScatteredRows {
  const double* first;
  const std::ptrdiff_t* offsets;
  const double* operator[](int j) const { return first + offsets[j]; }
};

namespace detail {

// The totals of four packs.
inline Pack totals(const Pack& s0, const Pack& s1, const Pack& s2, const Pack& s3) {
  const Pack low = __builtin_shufflevector(s0, s1, 0, 4, 2, 6) + __builtin_shufflevector(s0, s1, 1, 5, 3, 7);
  const Pack high = __builtin_shufflevector(s2, s3, 0, 4, 2, 6) + __builtin_shufflevector(s2, s3, 1, 5, 3, 7);
  return __builtin_shufflevector(low, high, 0, 1, 4, 5) + __builtin_shufflevector(low, high, 2, 3, 6, 7);
}

// `packs` packs of y from the k-th number on, from all rows, added to those of `start`. Few packs take two rows at a
// time, so that enough sums are in flight.
template <int packs, class Start, class Count, class Table>
inline void combine_packs(Count m, const Table& rows, int k, const double* c, Start start, double* y) {
  constexpr bool two_rows = packs <= 4;
  Pack sum[packs], second[packs] = {};
  for (int p = 0; p < packs; ++p) sum[p] = start.pack_at(k + pack * p);
  int j = 0;
  if constexpr (two_rows)
    for (; j + 2 <= m; j += 2) {
      const double *x = rows[j] + k, *next = rows[j + 1] + k;
      for (int p = 0; p < packs; ++p) {
        sum[p] += c[j] * pack_at(x + pack * p);
        second[p] += c[j + 1] * pack_at(next + pack * p);
      }
    }
  for (; j < m; ++j) {
    const double* x = rows[j] + k;
    for (int p = 0; p < packs; ++p) sum[p] += c[j] * pack_at(x + pack * p);
  }
  for (int p = 0; p < packs; ++p) pack_at(y + k + pack * p) = two_rows ? sum[p] + second[p] : sum[p];
}

struct Zeros {
  Pack pack_at(int) const { return Pack{}; }
};
struct Numbers {
  const double* x;
  Pack pack_at(int k) const { return simd::pack_at(x + k); }
};

template <class Start, class Length, class Count, class Table>
inline void combine_rows(Length n, Count m, const Table& rows, const double* c, Start start, double* y) {
  if constexpr (!std::is_same_v<Length, int>) {
    combine_packs<Length::value / pack>(m, rows, 0, c, start, y);
  } else {
    int k = 0;
    for (; k + 8 * pack <= n; k += 8 * pack) combine_packs<8>(m, rows, k, c, start, y);
    if (k + 4 * pack <= n) combine_packs<4>(m, rows, k, c, start, y), k += 4 * pack;
    if (k + 2 * pack <= n) combine_packs<2>(m, rows, k, c, start, y), k += 2 * pack;
    if (k < n) combine_packs<1>(m, rows, k, c, start, y);
  }
}

}  // namespace detail

// y = sum_j c_j rows_j  over m rows of length n
template <class Length, class Count, class Table>
inline void combine(Length n, Count m, const Table& rows, const double* c, double* y) {
  detail::combine_rows(n, m, rows, c, detail::Zeros{}, y);
}
// y = start + sum_j c_j rows_j
template <class Length, class Count, class Table>
inline void combine_from(const double* start, Length n, Count m, const Table& rows, const double* c, double* y) {
  detail::combine_rows(n, m, rows, c, detail::Numbers{start}, y);
}

// sum x y
template <class Length>
inline double dot(Length n, const double* x, const double* y) {
  Pack even{}, odd{};
  int k = 0;
  for (; k + 2 * pack <= n; k += 2 * pack) {
    even += pack_at(x + k) * pack_at(y + k);
    odd += pack_at(x + k + pack) * pack_at(y + k + pack);
  }
  if (k < n) even += pack_at(x + k) * pack_at(y + k);
  return total(even + odd);
}

// out_i = rows_i . y  over m rows, four at a time; where fewer remain, the last is repeated into out's padding
template <class Length, class Count>
inline void products(Length n, Count m, Rows rows, const double* y, double* out) {
  const auto row = [&](int i) { return rows[std::min<int>(i, m - 1)]; };
  for (int i = 0; i < m; i += pack) {
    const double *x0 = row(i), *x1 = row(i + 1), *x2 = row(i + 2), *x3 = row(i + 3);
    Pack s0{}, s1{}, s2{}, s3{};
    for (int k = 0; k < n; k += pack) {
      const Pack yk = pack_at(y + k);
      s0 += pack_at(x0 + k) * yk;
      s1 += pack_at(x1 + k) * yk;
      s2 += pack_at(x2 + k) * yk;
      s3 += pack_at(x3 + k) * yk;
    }
    pack_at(out + i) = detail::totals(s0, s1, s2, s3);
  }
}

}  // namespace trammel::beam
