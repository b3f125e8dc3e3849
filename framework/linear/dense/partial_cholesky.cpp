#include "linear/dense/partial_cholesky.hpp"

#include <algorithm>
#include <cmath>

#include "linear/dense/fixed_sizes.hpp"

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

// C(i, j) -= sum_p A(i, p) B(j, p) for 4 `packs` rows i and `columns` columns j
template <int packs, int columns>
inline void subtract_tile(Index depth, Index stride, const double* A, const double* B, double* C) {
  Pack sum[packs][columns] = {};
  for (Index p = 0; p < depth; ++p, A += stride, B += stride) {
    Pack a[packs];
    for (int i = 0; i < packs; ++i) a[i] = pack_at(A + pack * i);
    for (int j = 0; j < columns; ++j) {
      const Pack b = {B[j], B[j], B[j], B[j]};
      for (int i = 0; i < packs; ++i) sum[i][j] += a[i] * b;
    }
  }
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < packs; ++i) pack_at(C + j * stride + pack * i) -= sum[i][j];
}

// The lower triangle of A, whose columns are `stride` apart. Loops over rows begin with the pack that contains the
// diagonal.
struct Lower {
  double* A;
  Index n, stride;

  double* at(Index i, Index j) const { return A + j * stride + i; }

  template <int columns>
  void subtract_from(Index j, Index first, Index depth) const {
    Index i = pack_of(j);
    for (; i + 2 * pack < n; i += 3 * pack)
      subtract_tile<3, columns>(depth, stride, at(i, first), at(j, first), at(i, j));
    if (i + pack < n)
      subtract_tile<2, columns>(depth, stride, at(i, first), at(j, first), at(i, j));
    else if (i < n)
      subtract_tile<1, columns>(depth, stride, at(i, first), at(j, first), at(i, j));
  }

  // A(i, j) -= sum_p A(i, p) A(j, p) for columns p in [first, begin) and j in [begin, end)
  void subtract_products(Index first, Index begin, Index end) const {
    constexpr Index most_depth = 64;  // columns at a time, so that their memory pages and cache lines stay available
    for (Index p = first; p < begin; p += most_depth) {
      const Index depth = std::min(most_depth, begin - p);
      Index j = begin;
      for (; j + 4 <= end; j += 4) subtract_from<4>(j, p, depth);
      for (; j + 2 <= end; j += 2) subtract_from<2>(j, p, depth);
      if (j < end) subtract_from<1>(j, p, depth);
    }
  }

  // Columns [j, j + m): the square block on the diagonal, then all rows below it.
  template <int m>
  bool factorise_unrolled(Index j) const {
    double L[m][m], inverse[m];
    for (int b = 0; b < m; ++b)
      for (int a = b; a < m; ++a) {
        double rest = *at(j + a, j + b);
        for (int p = 0; p < b; ++p) rest -= L[a][p] * L[b][p];
        if (a == b && !(rest > 0)) return false;
        L[a][b] = a == b ? std::sqrt(rest) : rest * inverse[b];
        if (a == b) inverse[b] = 1 / L[b][b];
      }
    for (Index i = pack_of(j); i < n; i += pack) {
      Pack x[m];
      for (int b = 0; b < m; ++b) {
        x[b] = pack_at(at(i, j + b));
        for (int p = 0; p < b; ++p) x[b] -= x[p] * L[b][p];
        x[b] *= inverse[b];
      }
      for (int b = 0; b < m; ++b) pack_at(at(i, j + b)) = x[b];
    }
    for (int b = 0; b < m; ++b)
      for (int a = b; a < m; ++a) *at(j + a, j + b) = L[a][b];
    return true;
  }

  bool factorise(Index begin, Index end) const {
    const Index m = end - begin;
    bool definite = true;
    if (m <= most_unrolled) {
      with_fixed_size(m, [&](auto known) { definite = factorise_unrolled<int(known)>(begin); });
      return definite;
    }
    const Index half = begin + (m / 2 + most_unrolled - 1) / most_unrolled * most_unrolled;
    if (!factorise(begin, half)) return false;
    subtract_products(begin, half, end);
    return factorise(half, end);
  }
};

}  // namespace

bool partial_cholesky(double* A, Index n, Index k) {
  const Lower lower{A, n, column_stride(n)};
  if (!lower.factorise(0, k)) return false;
  lower.subtract_products(0, k, n);
  return true;
}

}  // namespace trammel::numerics
