#include "numerics/cholesky.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/packs.hpp"

namespace trammel::numerics {

bool Cholesky::compute(const Mat& M) {
  const Eigen::Index n = M.rows();
  if (n > most_in_packs) {
    resize(0);
    return blocks_.compute(M).info() == Eigen::Success && blocks_.matrixLLT().diagonal().allFinite();  // NaN: "success"
  }
  resize(n);
  for (Eigen::Index j = 0; j < n; ++j) std::copy(M.data() + j * n + j, M.data() + (j + 1) * n, &L_(j, j));
  return factorise_by_columns();
}

void Cholesky::resize(Eigen::Index n) {
  if (L_.cols() == n) return;
  L_.setZero(padded(n), n), U_.setZero(padded(n), n);
  inverse_.resize(n), root_.resize(n), inverse_root_.resize(n);
  rest_.setZero(padded(n));
}

// Each column less what those before it contribute, then divided by its pivot.
bool Cholesky::factorise_by_columns() {
  const Eigen::Index n = L_.cols(), stride = L_.rows();
  double *const L = L_.data(), *const U = U_.data();
  for (Eigen::Index j = 0; j < n; ++j) {
    double* const column = L + j * stride;
    const double* const shares = U + j * stride;
    for (Eigen::Index i = pack_of(j); i < stride; i += pack) {
      Pack rest = pack_at(column + i);
      for (Eigen::Index k = 0; k < j; ++k) rest -= shares[k] * pack_at(L + k * stride + i);
      pack_at(column + i) = rest;
    }
    if (!(column[j] > 0) || !std::isfinite(column[j])) return false;
    const double inverse = inverse_[j] = 1 / column[j];
    root_[j] = std::sqrt(column[j]), inverse_root_[j] = inverse * root_[j];
    for (Eigen::Index i = j; i < n; ++i) U[i * stride + j] = column[i];
    for (Eigen::Index i = pack_of(j); i < stride; i += pack) pack_at(column + i) *= inverse;
  }
  return true;
}

// By columns. A known number is taken out before the loop runs over its place, too.
void Cholesky::solve_lower(Eigen::Ref<Vec> x) {
  if (in_blocks()) return blocks_.matrixL().solveInPlace(x);
  const Eigen::Index n = L_.cols(), stride = L_.rows();
  double* const rest = rest_.data();
  std::copy_n(x.data(), n, rest);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double known = rest[j];
    x[j] = known * inverse_root_[j];
    subtract(known, L_.data() + j * stride, rest, j + 1, stride);
  }
}

void Cholesky::solve_lower(Mat& X) {
  for (Eigen::Index j = 0; j < X.cols(); ++j) solve_lower(X.col(j));
}

void Cholesky::solve_transposed(Eigen::Ref<Vec> x) {
  if (in_blocks()) return blocks_.matrixU().solveInPlace(x);
  const Eigen::Index n = L_.cols(), stride = L_.rows();
  double* const rest = rest_.data();
  for (Eigen::Index j = 0; j < n; ++j) rest[j] = x[j] * root_[j];
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    const double known = x[j] = rest[j] * inverse_[j];
    subtract(known, U_.data() + j * stride, rest, 0, j);
  }
}

void Cholesky::solve(Eigen::Ref<Vec> x) {
  solve_lower(x);
  solve_transposed(x);
}

}  // namespace trammel::numerics
