#include "numerics/lu.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace trammel::numerics {

namespace {

constexpr Eigen::Index small = 48;  // from about here on blocks are faster

}  // namespace

void Lu::compute(const Mat& A) {
  if (A.rows() > small) {
    rows_.clear();
    blocks_.compute(A);
    return;
  }
  LU_ = A;
  rows_.resize(std::size_t(A.rows()));
  std::iota(rows_.begin(), rows_.end(), Eigen::Index(0));
  eliminate();
}

void Lu::eliminate() {
  const Eigen::Index n = LU_.rows();
  double* const data = LU_.data();
  for (Eigen::Index j = 0; j < n; ++j) {
    double* const column = data + j * n;
    Eigen::Index p = j;
    for (Eigen::Index i = j + 1; i < n; ++i)
      if (std::abs(column[i]) > std::abs(column[p])) p = i;
    if (p != j) {
      for (Eigen::Index k = 0; k < n; ++k) std::swap(data[k * n + j], data[k * n + p]);
      std::swap(rows_[std::size_t(j)], rows_[std::size_t(p)]);
    }
    if (column[j] == 0) continue;
    const double scale = 1 / column[j];
    for (Eigen::Index i = j + 1; i < n; ++i) column[i] *= scale;
    for (Eigen::Index k = j + 1; k < n; ++k) {
      double* const right = data + k * n;
      const double share = right[j];
      for (Eigen::Index i = j + 1; i < n; ++i) right[i] -= share * column[i];
    }
  }
}

void Lu::solve(const Vec& b, Vec& x) const {
  if (in_blocks()) {
    x = blocks_.solve(b);
    return;
  }
  const Eigen::Index n = LU_.rows();
  x.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = b[rows_[std::size_t(i)]];
  double* const values = x.data();
  for (Eigen::Index j = 0; j < n; ++j) {
    const double* const column = LU_.data() + j * n;
    const double known = values[j];
    for (Eigen::Index i = j + 1; i < n; ++i) values[i] -= column[i] * known;
  }
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    const double* const column = LU_.data() + j * n;
    const double known = values[j] /= column[j];
    for (Eigen::Index i = 0; i < j; ++i) values[i] -= column[i] * known;
  }
}

}  // namespace trammel::numerics
