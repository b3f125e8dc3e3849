#include "numerics/frontal_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr Index least_size = 150;     // below, a dense elimination is as quick
constexpr double small_pivot = 1e-8;  // half of the digits would go

Eigen::Map<Mat> matrix(double* at, int rows, int columns) {
  return Eigen::Map<Mat>(at, rows, columns);
}

}  // namespace

// False: A has an entry outside of the pattern.
bool FrontalLu::take(const Mat& A) {
  if (A_.rows() != A.rows()) return false;
  Index taken = 0;
  double* const values = A_.valuePtr();
  largest_.setZero(A.cols());
  for (Index j = 0; j < A.cols(); ++j) {
    const double* column = A.data() + j * A.rows();
    for (auto k = A_.outerIndexPtr()[j]; k < A_.outerIndexPtr()[j + 1]; ++k) {
      values[k] = column[A_.innerIndexPtr()[k]];
      taken += values[k] != 0;
      largest_(j) = std::max(largest_(j), std::abs(values[k]));
    }
  }
  return taken == (A.array() != 0).count();
}

void FrontalLu::assemble(const Front& front, Eigen::Map<Mat>& F) {
  F.setZero();
  const double* const values = A_.valuePtr();
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

bool FrontalLu::factorise() {
  top_ = 0;
  for (const Front& front : fronts_) {
    auto F = matrix(work_.data(), front.size, front.size);
    assemble(front, F);
    if (!eliminate(front, F)) return false;
  }
  return true;
}

bool FrontalLu::compute(const Mat& A) {
  if (A.rows() < least_size) return false;
  if (!take(A)) {
    analyse(A);
    take(A);
  }
  return worthwhile_ && factorise();
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

void FrontalLu::solve(const Vec& b, Vec& x) {
  constexpr int most_corrections = 2;
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
  x = b;
  substitute(x);
  for (int i = 0; i < most_corrections; ++i) {
    residual_ = b;
    residual_.noalias() -= A_ * x;
    const double size = largest_.cwiseProduct(x).lpNorm<Eigen::Infinity>() + b.lpNorm<Eigen::Infinity>();
    if (!(residual_.lpNorm<Eigen::Infinity>() > round_off * size)) return;
    substitute(residual_);
    x += residual_;
  }
}

}  // namespace trammel::numerics
