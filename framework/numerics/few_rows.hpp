// Products with matrices X of few rows and any number of columns, as the rows of constraints are: loops over the columns, with what
// belongs to one of them in registers. For more rows Eigen's products are as fast.
#pragma once

#include <type_traits>

#include <trammel/types.hpp>

#include "numerics/packs.hpp"

namespace trammel::numerics {

// Calls f with the number of rows, known to the compiler. False: they are more than `few`, or none.
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

// S = X Y^T
inline void multiply_rows(const Mat& X, const Mat& Y, Mat& S) {
  S.resize(X.rows(), Y.rows());
  const auto of_few = [&](auto m) {
    double sum[m * m] = {};
    for (Eigen::Index j = 0; j < X.cols(); ++j)
      for (Eigen::Index k = 0; k < m; ++k)
        for (Eigen::Index i = 0; i < m; ++i) sum[k * m + i] += X.data()[j * m + i] * Y.data()[j * m + k];
    for (Eigen::Index k = 0; k < m * m; ++k) S.data()[k] = sum[k];
  };
  if (!with_few(X.rows(), of_few)) S.noalias() = X * Y.transpose();
}

}  // namespace trammel::numerics
