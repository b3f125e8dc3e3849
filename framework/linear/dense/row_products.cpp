#include "linear/dense/row_products.hpp"

#include "linear/dense/fixed_sizes.hpp"

namespace trammel::numerics {

namespace {

// S = X Y^T for Y with mostly zero entries, as for many bodies: adds a column of X for each non-zero entry of Y.
void multiply_sparse_rows(const Mat& X, const Mat& Y, Mat& S) {
  S.setZero();
  for (Eigen::Index j = 0; j < Y.cols(); ++j)
    for (Eigen::Index k = 0; k < Y.rows(); ++k)
      if (const double y = Y(k, j); y != 0) S.col(k) += y * X.col(j);
}

}  // namespace

void add_rows_product(double c, const Mat& X, const Vec& x, Vec& y) {
  const auto of_fixed = [&](auto m) {
    double sum[m] = {};
    for (Eigen::Index j = 0; j < X.cols(); ++j)
      for (Eigen::Index i = 0; i < m; ++i) sum[i] += X.data()[j * m + i] * x[j];
    for (Eigen::Index i = 0; i < m; ++i) y[i] += c * sum[i];
  };
  if (!with_fixed_size(X.rows(), of_fixed)) y.noalias() += c * (X * x);
}

void add_transposed_product(double c, const Mat& X, const Vec& y, Vec& x) {
  const auto of_fixed = [&](auto m) {
    double factors[m];
    for (Eigen::Index i = 0; i < m; ++i) factors[i] = c * y[i];
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      double sum = 0;
      for (Eigen::Index i = 0; i < m; ++i) sum += X.data()[j * m + i] * factors[i];
      x[j] += sum;
    }
  };
  if (!with_fixed_size(X.rows(), of_fixed)) x.noalias() += c * (X.transpose() * y);
}

void multiply_rows(const Mat& X, const Mat& Y, Mat& S) {
  constexpr double mostly_zero = 0.2;
  const Eigen::Index m = X.rows(), p = Y.rows(), n = X.cols();
  S.resize(m, p);
  if (m > most_unrolled || p > most_unrolled) {
    if (double((Y.array() != 0).count()) < mostly_zero * double(Y.size())) return multiply_sparse_rows(X, Y, S);
    return void(S.noalias() = X * Y.transpose());
  }
  in_fixed_parts(m, [&](auto rows, Eigen::Index i) {
    in_fixed_parts<4>(p, [&](auto columns, Eigen::Index k) {
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
