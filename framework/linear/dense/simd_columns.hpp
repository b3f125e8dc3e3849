// Loops over columns in whole SIMD packs of four numbers, for factorisations of a few dozen unknowns.
//
// Loops over the rows as they are spend much of their time on the numbers after the last whole pack, and on packs that
// read what two earlier ones wrote. Therefore matrices have padded columns, and each loop begins with the pack that
// contains its first row; its effect on the rows before, and on the padding, must not matter. Timings:
// tools/bench/README.md.
#pragma once

#include <Eigen/Core>

#include <trammel/simd.hpp>
#include <trammel/types.hpp>

namespace trammel::numerics {

using simd::pack, simd::Pack, simd::pack_at, simd::padded, simd::total;

inline constexpr Eigen::Index most_in_packs = 48;  // unknowns; from about here on Eigen's blocked algorithms are faster
constexpr Eigen::Index pack_of(Eigen::Index i) {
  return i / pack * pack;
}

// For the pack of row i: 1 from that row on, 0 before.
inline const simd::PackInMemory& rows_from(Eigen::Index i) {
  static constexpr double step[] = {0, 0, 0, 1, 1, 1, 1};
  return pack_at(step + pack - 1 - i % pack);
}

// For so few unknowns the compiler unrolls loops of fixed length completely, and the solution stays in registers.
// Smaller systems are filled up with 1 on the diagonal.
inline constexpr int most_unrolled = 8;

// Copies A (m x m, m <= n) and fills up with rows and columns of the identity. (The recursion reduces n to m, which is
// then a compile-time constant.)
template <int n = most_unrolled>
void copy_unrolled(const double* A, Eigen::Index m, double* to) {
  if constexpr (n > 1)
    if (m < n) return copy_unrolled<n - 1>(A, m, to);
  for (int j = 0; j < most_unrolled; ++j)
    for (int i = 0; i < most_unrolled; ++i) to[j * most_unrolled + i] = i < n && j < n ? A[j * n + i] : i == j;
}

template <int n = most_unrolled>
void add_unrolled_product(double c, const double* A, Eigen::Index m, const double* x, double* y) {
  if constexpr (n > 1)
    if (m < n) return add_unrolled_product<n - 1>(c, A, m, x, y);
  double sum[n] = {};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) sum[i] += A[j * n + i] * x[j];
  for (int i = 0; i < n; ++i) y[i] += c * sum[i];
}
// y += c A x, A square
inline void add_product(double c, const Mat& A, const Vec& x, Vec& y) {
  if (A.rows() > most_unrolled || A.rows() == 0)
    y.noalias() += c * (A * x);
  else
    add_unrolled_product(c, A.data(), A.rows(), x.data(), y.data());
}

class UnrolledVector {
 public:
  // The first n numbers are x[0], x[1], ... or x[order[0]], x[order[1]], ...; the others are 0.
  UnrolledVector(Eigen::Index n, const double* x) {
    for (int i = 0; i < most_unrolled; ++i) y_[i] = i < n ? x[i] : 0;
  }
  UnrolledVector(Eigen::Index n, const double* x, const Eigen::Index* order) {
    for (int i = 0; i < most_unrolled; ++i) y_[i] = i < n ? x[order[i]] : 0;
  }
  // L has a unit diagonal and columns `most_unrolled` apart: y := L^-1 y,  y := L^-T y,  y := U^-1 y
  void solve_lower(const double* L) {
#pragma GCC unroll 8
    for (int j = 0; j < most_unrolled; ++j)
#pragma GCC unroll 8
      for (int i = j + 1; i < most_unrolled; ++i) y_[i] -= L[j * most_unrolled + i] * y_[j];
  }
  void solve_transposed(const double* L) {
#pragma GCC unroll 8
    for (int j = most_unrolled - 1; j >= 0; --j)
#pragma GCC unroll 8
      for (int i = most_unrolled - 1; i > j; --i) y_[j] -= L[j * most_unrolled + i] * y_[i];
  }
  void solve_upper(const double* U, const double* inverse_diagonal) {
#pragma GCC unroll 8
    for (int j = most_unrolled - 1; j >= 0; --j) {
      y_[j] *= inverse_diagonal[j];
#pragma GCC unroll 8
      for (int i = 0; i < j; ++i) y_[i] -= U[j * most_unrolled + i] * y_[j];
    }
  }
  void scale(const double* by) {
    for (int i = 0; i < most_unrolled; ++i) y_[i] *= by[i];
  }
  void copy_to(double* x, Eigen::Index n) const {
    for (int i = 0; i < most_unrolled; ++i)
      if (i < n) x[i] = y_[i];
  }

 private:
  double y_[most_unrolled];
};

// y -= c x in the packs that contain rows [first, end)
inline void subtract(double c, const double* x, double* y, Eigen::Index first, Eigen::Index end) {
  for (Eigen::Index i = pack_of(first); i < end; i += pack) pack_at(y + i) -= c * pack_at(x + i);
}

}  // namespace trammel::numerics
