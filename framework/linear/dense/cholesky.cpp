#include "linear/dense/cholesky.hpp"

#include <algorithm>
#include <cmath>

#include "linear/dense/fixed_sizes.hpp"
#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

bool is_diagonal(const Mat& M) {
  for (Eigen::Index j = 0; j < M.cols(); ++j)
    for (Eigen::Index i = j + 1; i < M.rows(); ++i)
      if (M(i, j) != 0) return false;
  return true;
}

bool Cholesky::compute(const Mat& M) {
  const Eigen::Index n = M.rows();
  diagonal_ = is_diagonal(M);
  if (diagonal_) return invert_diagonal(M);
  if (n > most_in_packs) {
    resize(0);
    return blocks_.compute(M).info() == Eigen::Success && blocks_.matrixLLT().diagonal().allFinite();  // NaN: "success"
  }
  resize(n);
  if (unrolled()) {
    copy_unrolled(M.data(), n, U_.data());
    return factorise_unrolled();
  }
  find_zeros(M);
  for (Eigen::Index j = 0; j < n; ++j) std::copy(M.data() + j * n + j, M.data() + (j + 1) * n, &L_(j, j));
  return factorise_by_columns();
}

// For any size: hundreds of bodies that nothing couples cost no more than one by one.
bool Cholesky::invert_diagonal(const Mat& M) {
  n_ = M.rows();
  root_ = M.diagonal().cwiseSqrt();
  inverse_ = M.diagonal().cwiseInverse();
  inverse_root_ = inverse_.cwiseProduct(root_);
  return (M.diagonal().array() > 0).all() && M.diagonal().allFinite();
}

void Cholesky::resize(Eigen::Index n) {
  if (n_ == n && L_.rows() == padded(n) && inverse_.size() == L_.cols()) return;
  n_ = n;
  const Eigen::Index stride = padded(n), columns = stride == most_unrolled ? most_unrolled : n;
  L_.setIdentity(stride, columns), U_.setIdentity(stride, columns);
  inverse_.setOnes(columns), root_.setOnes(columns), inverse_root_.setOnes(columns);
  rest_.setZero(stride);
  first_.assign(std::size_t(n), 0), end_.assign(std::size_t(n), n);
}

void Cholesky::find_zeros(const Mat& M) {
  first_before_.swap(first_);
  first_.resize(std::size_t(n_));
  for (Eigen::Index i = 0; i < n_; ++i) {
    Eigen::Index j = 0;
    while (j < i && M(i, j) == 0) ++j;
    first_[std::size_t(i)] = j;
  }
  if (first_ == first_before_) return;
  U_.setIdentity();  // for entries that are no longer written
  Eigen::Index end = 0;
  for (Eigen::Index j = 0; j < n_; ++j) {
    for (Eigen::Index i = std::max(end, j); i < n_; ++i)
      if (first_[std::size_t(i)] <= j) end = i + 1;
    end_[std::size_t(j)] = end;
  }
}

// As by columns, with all columns in registers.
bool Cholesky::factorise_unrolled() {
  double *const L = L_.data(), *const LD = U_.data();
  bool positive = true;
#pragma GCC unroll 8
  for (int j = 0; j < most_unrolled; ++j) {
    const int first = j / int(pack);
    Pack column[most_unrolled / pack];
#pragma GCC unroll 2
    for (int p = first; p < most_unrolled / pack; ++p) {
      column[p] = pack_at(LD + j * most_unrolled + p * pack);
#pragma GCC unroll 8
      for (int k = 0; k < j; ++k) column[p] -= L[k * most_unrolled + j] * pack_at(LD + k * most_unrolled + p * pack);
    }
    const double pivot = column[first][j % pack];
    positive &= pivot > 0 && std::isfinite(pivot);
    const double inverse = inverse_[j] = 1 / pivot;
    root_[j] = std::sqrt(pivot), inverse_root_[j] = inverse * root_[j];
#pragma GCC unroll 2
    for (int p = first; p < most_unrolled / pack; ++p) {
      pack_at(LD + j * most_unrolled + p * pack) = column[p];
      pack_at(L + j * most_unrolled + p * pack) = column[p] * inverse;
    }
  }
  return positive;
}

// Subtracts the contributions of earlier columns from each column and divides it by its pivot.
bool Cholesky::factorise_by_columns() {
  const Eigen::Index n = n_, stride = L_.rows();
  double *const L = L_.data(), *const U = U_.data();
  for (Eigen::Index j = 0; j < n; ++j) {
    double* const column = L + j * stride;
    const double* const shares = U + j * stride;
    const Eigen::Index first = first_[std::size_t(j)], end = end_[std::size_t(j)];
    for (Eigen::Index i = pack_of(j); i < end; i += pack) {
      Pack rest = pack_at(column + i);
      for (Eigen::Index k = first; k < j; ++k) rest -= shares[k] * pack_at(L + k * stride + i);
      pack_at(column + i) = rest;
    }
    if (!(column[j] > 0) || !std::isfinite(column[j])) return false;
    const double inverse = inverse_[j] = 1 / column[j];
    root_[j] = std::sqrt(column[j]), inverse_root_[j] = inverse * root_[j];
    for (Eigen::Index i = j; i < end; ++i) U[i * stride + j] = column[i];
    for (Eigen::Index i = pack_of(j); i < end; i += pack) pack_at(column + i) *= inverse;
  }
  return true;
}

// By columns. A solved entry is read before the loop overwrites its place.
void Cholesky::solve_lower(Eigen::Ref<Vec> x) {
  if (in_blocks()) return blocks_.matrixL().solveInPlace(x);
  if (diagonal_) return void(x.array() *= inverse_root_.head(n_).array());
  if (unrolled()) {
    UnrolledVector y(n_, x.data());
    y.solve_lower(L_.data());
    y.scale(inverse_root_.data());
    return y.copy_to(x.data(), n_);
  }
  const Eigen::Index n = n_, stride = L_.rows();
  double* const rest = rest_.data();
  std::copy_n(x.data(), n, rest);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double known = rest[j];
    x[j] = known * inverse_root_[j];
    subtract(known, L_.data() + j * stride, rest, j + 1, end_[std::size_t(j)]);
  }
}

// A part of the rows at a time, each by columns: subtracts the contributions of earlier columns.
void Cholesky::solve_lower_of_rows(Eigen::Ref<Mat> X) const {
  if (X.rows() == 0) return;
  if (in_blocks()) return blocks_.matrixU().solveInPlace<Eigen::OnTheRight>(X);
  const Eigen::Index m = X.rows(), stride = X.outerStride();
  in_fixed_parts(m, [&](auto rows, Eigen::Index i) {
    double* const x = X.data() + i;
    for (Eigen::Index k = 0; k < n_; ++k) {
      PartOfRows<rows> rest = part_at<rows>(x + k * stride);
      for (Eigen::Index j = diagonal_ ? k : first_[std::size_t(k)]; j < k; ++j)
        rest -= L_(k, j) * part_at<rows>(x + j * stride);
      part_at<rows>(x + k * stride) = rest;
    }
    for (Eigen::Index k = 0; k < n_; ++k) part_at<rows>(x + k * stride) *= inverse_root_[k];
  });
}

void Cholesky::solve_transposed(Eigen::Ref<Vec> x) {
  if (in_blocks()) return blocks_.matrixU().solveInPlace(x);
  if (diagonal_) return void(x.array() = x.array() * root_.head(n_).array() * inverse_.head(n_).array());
  if (unrolled()) {
    UnrolledVector y(n_, x.data());
    y.scale(inverse_root_.data());
    y.solve_transposed(L_.data());
    return y.copy_to(x.data(), n_);
  }
  const Eigen::Index n = n_, stride = L_.rows();
  double* const rest = rest_.data();
  for (Eigen::Index j = 0; j < n; ++j) rest[j] = x[j] * root_[j];
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    const double known = x[j] = rest[j] * inverse_[j];
    subtract(known, U_.data() + j * stride, rest, first_[std::size_t(j)], j);
  }
}

void Cholesky::solve(Eigen::Ref<Vec> x) {
  if (diagonal_) return void(x.array() *= inverse_.head(n_).array());
  if (unrolled()) {
    UnrolledVector y(n_, x.data());
    y.solve_lower(L_.data());
    y.scale(inverse_.data());
    y.solve_transposed(L_.data());
    return y.copy_to(x.data(), n_);
  }
  solve_lower(x);
  solve_transposed(x);
}

}  // namespace trammel::numerics
