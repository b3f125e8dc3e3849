// Products with matrices X of few rows and any number of columns, such as the rows of constraints: loops over the
// columns, with the values of one column in registers. For more rows Eigen's products are as fast, unless each row
// touches few of the columns.
#pragma once

#include <type_traits>

#include <trammel/types.hpp>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

// Calls f with the number of rows as a compile-time constant. False: there are more than `few`, or none.
template <int m = few, class F>
bool with_few(Eigen::Index rows, F&& f) {
  if constexpr (m > 0) {
    if (rows != m) return with_few<m - 1>(rows, f);
    f(std::integral_constant<Eigen::Index, m>());
  }
  return m > 0;
}

// y += c X x
inline void add_rows_product(double c, const Mat& X, const Vec& x, Vec& y) {
  const auto of_few = [&](auto m) {
    double sum[m] = {};
    for (Eigen::Index j = 0; j < X.cols(); ++j)
      for (Eigen::Index i = 0; i < m; ++i) sum[i] += X.data()[j * m + i] * x[j];
    for (Eigen::Index i = 0; i < m; ++i) y[i] += c * sum[i];
  };
  if (!with_few(X.rows(), of_few)) y.noalias() += c * (X * x);
}

// x += c X^T y
inline void add_transposed_product(double c, const Mat& X, const Vec& y, Vec& x) {
  const auto of_few = [&](auto m) {
    double factors[m];
    for (Eigen::Index i = 0; i < m; ++i) factors[i] = c * y[i];
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      double sum = 0;
      for (Eigen::Index i = 0; i < m; ++i) sum += X.data()[j * m + i] * factors[i];
      x[j] += sum;
    }
  };
  if (!with_few(X.rows(), of_few)) x.noalias() += c * (X.transpose() * y);
}

// Splits m into consecutive parts, eights and then at most one of 4, 2 and 1, and calls f(number, first) with the
// number as a compile-time constant. The values of a part stay in registers; a loop over all m rows at once would keep
// them in memory.
template <Eigen::Index part = few, class F>
void in_parts(Eigen::Index m, F&& f, Eigen::Index first = 0) {
  for (; first + part <= m; first += part) f(std::integral_constant<Eigen::Index, part>(), first);
  if constexpr (part > 1) in_parts<part / 2>(m, f, first);
}

template <Eigen::Index part>
using PartOfRows = Eigen::Array<double, part, 1>;
template <Eigen::Index part>
Eigen::Map<PartOfRows<part>> part_at(double* x) {
  return Eigen::Map<PartOfRows<part>>(x);
}
template <Eigen::Index part>
Eigen::Map<const PartOfRows<part>> part_at(const double* x) {
  return Eigen::Map<const PartOfRows<part>>(x);
}

// S = X Y^T for Y with mostly zero entries, as for many bodies: adds a column of X for each non-zero entry of Y.
inline void multiply_sparse_rows(const Mat& X, const Mat& Y, Mat& S) {
  S.setZero();
  for (Eigen::Index j = 0; j < Y.cols(); ++j)
    for (Eigen::Index k = 0; k < Y.rows(); ++k)
      if (const double y = Y(k, j); y != 0) S.col(k) += y * X.col(j);
}

// S = X Y^T
inline void multiply_rows(const Mat& X, const Mat& Y, Mat& S) {
  constexpr double mostly_zero = 0.2;
  const Eigen::Index m = X.rows(), p = Y.rows(), n = X.cols();
  S.resize(m, p);
  if (m > few || p > few) {
    if (double((Y.array() != 0).count()) < mostly_zero * double(Y.size())) return multiply_sparse_rows(X, Y, S);
    return void(S.noalias() = X * Y.transpose());
  }
  in_parts(m, [&](auto rows, Eigen::Index i) {
    in_parts<4>(p, [&](auto columns, Eigen::Index k) {
      PartOfRows<rows> sum[columns];
      for (PartOfRows<rows>& column : sum) column.setZero();
      const double *x = X.data() + i, *y = Y.data() + k;
      for (Eigen::Index j = 0; j < n; ++j, x += m, y += p)
        for (Eigen::Index c = 0; c < columns; ++c) sum[c] += part_at<rows>(x) * y[c];
      for (Eigen::Index c = 0; c < columns; ++c) part_at<rows>(S.data() + (k + c) * m + i) = sum[c];
    });
  });
}

}  // namespace trammel::numerics
