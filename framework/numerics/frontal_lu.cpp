#include "numerics/frontal_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double small_pivot = 64 * eps;

Eigen::Map<Mat> matrix(double* at, int rows, int columns) {
  return Eigen::Map<Mat>(at, rows, columns);
}

}  // namespace

void FrontalLu::measure(const Sparse& A) {
  largest_.setZero(A.cols());
  for (Index j = 0; j < A.cols(); ++j)
    for (auto k = A.outerIndexPtr()[j]; k < A.outerIndexPtr()[j + 1]; ++k)
      largest_(j) = std::max(largest_(j), std::abs(A.valuePtr()[k]));
}

void FrontalLu::assemble(const Front& front, const double* values, Eigen::Map<Mat>& F) {
  F.setZero();
  for (std::size_t e = front.entries.begin; e < front.entries.end; ++e)
    F.data()[entries_[e].to] = values[entries_[e].from];
  for (std::size_t c = 0; c < front.maps.size(); ++c) {
    const int* const map = maps_.data() + front.maps[c];
    const int n = front.boundaries[c];
    top_ -= std::size_t(n) * std::size_t(n);
    const double* from = stack_.data() + top_;
    for (int j = 0; j < n; ++j, from += n) {
      double* const column = F.data() + std::size_t(map[j]) * std::size_t(front.size);
      for (int i = 0; i < n; ++i) column[map[i]] += from[i];
    }
  }
}

bool FrontalLu::eliminate(const Front& front, Eigen::Map<Mat>& F) {
  const int n = front.size, k = front.eliminated, b = n - k;
  Eigen::Ref<Mat> corner = F.topLeftCorner(k, k);
  const Eigen::PartialPivLU<Eigen::Ref<Mat>> lu(corner);
  const int* const unknowns = unknowns_.data() + front.unknowns;
  for (int j = 0; j < k; ++j) {
    const double pivot = pivots_(unknowns[j]) = F(j, j);
    if (!(std::abs(pivot) > small_pivot * largest_(unknowns[j]))) return false;
    exchanged_[front.unknowns + std::size_t(lu.permutationP().indices()(j))] = unknowns[j];
  }
  double* const at = store_.data() + front.factors;
  auto left = matrix(at, n, k), right = matrix(at + n * k, k, b);
  if (b > 0) {
    right.noalias() = lu.permutationP() * F.topRightCorner(k, b);
    corner.triangularView<Eigen::UnitLower>().solveInPlace(right);
    auto below = F.bottomLeftCorner(b, k);
    corner.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
    auto rest = matrix(stack_.data() + top_, b, b);
    rest = F.bottomRightCorner(b, b);
    rest.noalias() -= below * right;
    top_ += std::size_t(b) * std::size_t(b);
  }
  left = F.leftCols(k);
  return true;
}

bool FrontalLu::factorise(const Sparse& A) {
  measure(A);
  top_ = 0;
  for (const Front& front : fronts_) {
    auto F = matrix(work_.data(), front.size, front.size);
    assemble(front, A.valuePtr(), F);
    if (!eliminate(front, F)) return false;
  }
  return true;
}

// L U x = x
void FrontalLu::substitute(Vec& x) {
  for (const Front& front : fronts_) {
    const int n = front.size, k = front.eliminated;
    const int *const unknowns = unknowns_.data() + front.unknowns, *const rows = exchanged_.data() + front.unknowns;
    const auto left = matrix(store_.data() + front.factors, n, k);
    y_.resize(n);
    for (int i = 0; i < k; ++i) y_(i) = x(rows[i]);
    left.topRows(k).triangularView<Eigen::UnitLower>().solveInPlace(y_.head(k));
    y_.tail(n - k).noalias() = left.bottomRows(n - k) * y_.head(k);
    for (int i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
    for (int i = k; i < n; ++i) x(unknowns[i]) -= y_(i);
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int n = front->size, k = front->eliminated;
    const int* const unknowns = unknowns_.data() + front->unknowns;
    double* const at = store_.data() + front->factors;
    y_.resize(n);
    for (int i = 0; i < n; ++i) y_(i) = x(unknowns[i]);
    y_.head(k).noalias() -= matrix(at + n * k, k, n - k) * y_.tail(n - k);
    matrix(at, n, k).topRows(k).triangularView<Eigen::Upper>().solveInPlace(y_.head(k));
    for (int i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
  }
}

bool FrontalLu::solve(const Sparse& A, const Vec& b, Vec& x) {
  constexpr int most_corrections = 10;
  constexpr double round_off = 64 * eps, good = 1e-10;  // of the equations
  x = b;
  substitute(x);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0;; ++i) {
    residual_ = b;
    residual_.noalias() -= A * x;
    const double size = largest_.cwiseProduct(x).lpNorm<Eigen::Infinity>() + b.lpNorm<Eigen::Infinity>();
    const double left = residual_.lpNorm<Eigen::Infinity>();
    if (left <= round_off * size) return true;
    if (i == most_corrections || !(left < before / 2)) return left <= good * size;
    before = left;
    substitute(residual_);
    x += residual_;
  }
}

}  // namespace trammel::numerics
