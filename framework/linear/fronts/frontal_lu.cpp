#include "linear/fronts/frontal_lu.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr double small_pivot = 64 * std::numeric_limits<double>::epsilon();

Eigen::Map<Mat> matrix(double* at, int rows, int columns) {
  return Eigen::Map<Mat>(at, rows, columns);
}

std::size_t factors_of(const FrontalPattern::Front& front) {
  return std::size_t(front.eliminated) * std::size_t(2 * front.size - front.eliminated);
}

}  // namespace

void FrontalLu::assemble(const FrontalPattern& pattern, const Front& front, const double* values, Eigen::Map<Mat>& F) {
  F.setZero();
  pattern.each_entry(front,
                     [&](const FrontalPattern::Entry& entry) { F(entry.row, entry.column) = values[entry.from]; });
  for (const FrontalPattern::Child& child : front.children) {
    const int n = child.boundary, *const map = pattern.map(child);
    top_ -= std::size_t(n) * std::size_t(n);
    const double* from = stack_.data() + top_;
    for (int j = 0; j < n; ++j, from += n) {
      double* const column = F.data() + Index(map[j]) * front.size;
      for (int i = 0; i < n; ++i) column[map[i]] += from[i];
    }
  }
}

bool FrontalLu::eliminate(const FrontalPattern& pattern, const Front& front, const Vec& largest, Eigen::Map<Mat>& F) {
  const int n = front.size, k = front.eliminated, b = n - k;
  Eigen::Ref<Mat> corner = F.topLeftCorner(k, k);
  const Eigen::PartialPivLU<Eigen::Ref<Mat>> lu(corner);
  const int* const unknowns = pattern.unknowns(front);
  for (int j = 0; j < k; ++j) {
    const double pivot = pivots_(unknowns[j]) = F(j, j);
    if (!(std::abs(pivot) > small_pivot * largest(unknowns[j]))) return false;
    exchanged_[front.unknowns + std::size_t(lu.permutationP().indices()(j))] = unknowns[j];
  }
  double* const at = store_.data() + stored_;
  stored_ += factors_of(front);
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

bool FrontalLu::factorise(const FrontalPattern& pattern, const Sparse& A, const Vec& largest) {
  std::size_t all = 0;
  for (const Front& front : pattern.fronts()) all += factors_of(front);
  store_.resize(Index(all));
  work_.resize(Index(pattern.largest()) * pattern.largest());
  stack_.resize(Index(pattern.most_waiting()));
  exchanged_.resize(pattern.all_unknowns());
  pivots_.resize(A.cols());
  stored_ = top_ = 0;
  for (const Front& front : pattern.fronts()) {
    auto F = matrix(work_.data(), front.size, front.size);
    assemble(pattern, front, A.valuePtr(), F);
    if (!eliminate(pattern, front, largest, F)) return false;
  }
  return true;
}

// L U x = x
void FrontalLu::substitute(const FrontalPattern& pattern, Vec& x) {
  double* at = store_.data();
  for (const Front& front : pattern.fronts()) {
    const int n = front.size, k = front.eliminated;
    const int *const unknowns = pattern.unknowns(front), *const rows = exchanged_.data() + front.unknowns;
    const auto left = matrix(at, n, k);
    at += factors_of(front);
    y_.resize(n);
    for (int i = 0; i < k; ++i) y_(i) = x(rows[i]);
    left.topRows(k).triangularView<Eigen::UnitLower>().solveInPlace(y_.head(k));
    y_.tail(n - k).noalias() = left.bottomRows(n - k) * y_.head(k);
    for (int i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
    for (int i = k; i < n; ++i) x(unknowns[i]) -= y_(i);
  }
  for (auto front = pattern.fronts().rbegin(); front != pattern.fronts().rend(); ++front) {
    const int n = front->size, k = front->eliminated;
    const int* const unknowns = pattern.unknowns(*front);
    at -= factors_of(*front);
    y_.resize(n);
    for (int i = 0; i < n; ++i) y_(i) = x(unknowns[i]);
    y_.head(k).noalias() -= matrix(at + n * k, k, n - k) * y_.tail(n - k);
    matrix(at, n, k).topRows(k).triangularView<Eigen::Upper>().solveInPlace(y_.head(k));
    for (int i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
  }
}

}  // namespace trammel::numerics
