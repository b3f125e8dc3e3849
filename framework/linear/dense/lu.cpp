#include "linear/dense/lu.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

void Lu::compute(const Mat& A) {
  const Eigen::Index n = A.rows();
  if (n > most_in_packs) {
    n_ = 0;
    blocks_.compute(A);
    return;
  }
  if (n_ != n) {
    n_ = n;
    LU_.setIdentity(padded(n), unrolled() ? most_unrolled : n);
    rest_.setZero(LU_.rows()), y_.setZero(LU_.rows());
    inverse_pivots_.setOnes(LU_.cols());
    rows_.resize(std::size_t(n));
  }
  if (unrolled()) {
    copy_unrolled(A.data(), n, LU_.data());
  } else {
    for (Eigen::Index j = 0; j < n; ++j) std::copy_n(A.data() + j * n, n, LU_.data() + j * LU_.rows());
  }
  std::iota(rows_.begin(), rows_.end(), Eigen::Index(0));
  eliminate();
}

void Lu::eliminate() {
  const Eigen::Index n = n_, stride = LU_.rows();
  double* const data = LU_.data();
  double multipliers[most_in_packs];
  for (Eigen::Index j = 0; j < n; ++j) {
    double* const column = data + j * stride;
    Eigen::Index p = j;
    for (Eigen::Index i = j + 1; i < n; ++i)
      if (std::abs(column[i]) > std::abs(column[p])) p = i;
    if (p != j) {
      for (Eigen::Index k = 0; k < n; ++k) std::swap(data[k * stride + j], data[k * stride + p]);
      std::swap(rows_[std::size_t(j)], rows_[std::size_t(p)]);
    }
    const double inverse = inverse_pivots_[j] = 1 / column[j];
    if (column[j] == 0 || j + 1 == n) continue;
    // Multipliers of the rows below the pivot; 0 for the finished rows above.
    const Eigen::Index first = pack_of(j + 1);
    const Pack below = rows_from(j + 1);
    pack_at(multipliers + first) = inverse * below * pack_at(column + first);
    pack_at(column + first) = pack_at(multipliers + first) + (1 - below) * pack_at(column + first);
    for (Eigen::Index i = first + pack; i < stride; i += pack)
      pack_at(multipliers + i) = pack_at(column + i) *= inverse;
    for (Eigen::Index k = j + 1; k < n; ++k) {
      double* const right = data + k * stride;
      subtract(right[j], multipliers, right, first, stride);
    }
  }
}

std::vector<Eigen::Index> Lu::rows() const {
  if (!in_blocks()) return rows_;
  std::vector<Eigen::Index> all(std::size_t(blocks_.rows()));
  for (std::size_t i = 0; i < all.size(); ++i)
    all[std::size_t(blocks_.permutationP().indices()[Eigen::Index(i)])] = Eigen::Index(i);
  return all;
}

bool Lu::is_small_pivot(const Mat& A, double least, Eigen::Index j) const {
  return !(std::abs(pivot(j)) > least * A.col(j).cwiseAbs().maxCoeff());
}

// The largest entry of A is tried first, which is cheaper and nearly always sufficient.
bool Lu::has_small_pivot(const Mat& A, double least, Eigen::Index first) const {
  const double largest = A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0;
  for (Eigen::Index j = first; j < A.cols(); ++j)
    if (!(std::abs(pivot(j)) > least * largest) && is_small_pivot(A, least, j)) return true;
  return false;
}

// Forward and backward substitution by columns. A solved entry is read before the loop overwrites its place.
void Lu::solve(const Vec& b, Vec& x) {
  if (in_blocks()) {
    x = blocks_.solve(b);
    return;
  }
  const Eigen::Index n = n_, stride = LU_.rows();
  const double* const data = LU_.data();
  double *const rest = rest_.data(), *const y = y_.data();
  x.resize(n);
  if (unrolled()) {
    UnrolledVector y_unrolled(n, b.data(), rows_.data());
    y_unrolled.solve_lower(data);
    y_unrolled.solve_upper(data, inverse_pivots_.data());
    return y_unrolled.copy_to(x.data(), n);
  }
  for (Eigen::Index i = 0; i < n; ++i) rest[i] = b[rows_[std::size_t(i)]];
  for (Eigen::Index j = 0; j < n; ++j) {
    y[j] = rest[j];
    subtract(y[j], data + j * stride, rest, j + 1, stride);
  }
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    x[j] = y[j] * inverse_pivots_[j];
    subtract(x[j], data + j * stride, y, 0, j);
  }
}

}  // namespace trammel::numerics
