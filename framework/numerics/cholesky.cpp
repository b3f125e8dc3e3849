#include "numerics/cholesky.hpp"

#include <Eigen/Cholesky>

#include <cmath>

namespace trammel::numerics {

namespace {

constexpr Eigen::Index small = 48;  // from about here on blocks are faster

// Each column less what those before it contribute, then divided by the root of its pivot.
bool factorise_by_columns(Mat& L) {
  const Eigen::Index n = L.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    double* const column = L.data() + j * n;
    for (Eigen::Index k = 0; k < j; ++k) {
      const double* const before = L.data() + k * n;
      const double share = before[j];
      for (Eigen::Index i = j; i < n; ++i) column[i] -= share * before[i];
    }
    if (!(column[j] > 0) || !std::isfinite(column[j])) return false;
    column[j] = std::sqrt(column[j]);
    const double scale = 1 / column[j];
    for (Eigen::Index i = j + 1; i < n; ++i) column[i] *= scale;
  }
  return true;
}

}  // namespace

bool Cholesky::compute(const Mat& M) {
  L_ = M;
  if (L_.rows() <= small) return factorise_by_columns(L_);
  return Eigen::LLT<Eigen::Ref<Mat>>(L_).info() == Eigen::Success && L_.diagonal().allFinite();  // NaN: "success"
}

void Cholesky::solve_lower(Eigen::Ref<Vec> x) const {
  const Eigen::Index n = L_.rows();
  double* const values = x.data();
  for (Eigen::Index j = 0; j < n; ++j) {
    const double* const column = L_.data() + j * n;
    const double known = values[j] /= column[j];
    for (Eigen::Index i = j + 1; i < n; ++i) values[i] -= column[i] * known;
  }
}

void Cholesky::solve_lower(Mat& X) const {
  for (Eigen::Index j = 0; j < X.cols(); ++j) solve_lower(X.col(j));
}

void Cholesky::solve_transposed(Eigen::Ref<Vec> x) const {
  const Eigen::Index n = L_.rows();
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    const Eigen::Index below = n - 1 - j;
    const double known = Eigen::Map<const Vec>(L_.data() + j * n + j + 1, below).dot(x.tail(below));
    x[j] = (x[j] - known) / L_(j, j);
  }
}

void Cholesky::solve(Eigen::Ref<Vec> x) const {
  solve_lower(x);
  solve_transposed(x);
}

}  // namespace trammel::numerics
