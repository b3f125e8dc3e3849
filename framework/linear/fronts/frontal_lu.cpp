#include "linear/fronts/frontal_lu.hpp"

#include <algorithm>
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

// In fronts of up to this many unknowns a loop over a column is faster than Eigen's expression.
constexpr int small_front = 64;

// to[i] -= c from[i]
void subtract(double c, const double* from, int n, double* to) {
  for (int i = 0; i < n; ++i) to[i] -= c * from[i];
}

// P F_FF = L U with row exchanges within F, L_BF and U_FB, and S in the corner; `rows` receives the order of the rows.
void eliminate_columns(double* F, int n, int k, int* rows) {
  for (int j = 0; j < k; ++j) {
    double* const column = F + std::ptrdiff_t(j) * n;
    int largest = j;
    for (int i = j + 1; i < k; ++i)
      if (std::abs(column[i]) > std::abs(column[largest])) largest = i;
    if (largest != j) {
      std::swap(rows[j], rows[largest]);
      for (int c = 0; c < n; ++c) std::swap(F[std::ptrdiff_t(c) * n + j], F[std::ptrdiff_t(c) * n + largest]);
    }
    if (column[j] == 0) continue;  // the caller rejects it
    const double inverse = 1 / column[j];
    for (int i = j + 1; i < n; ++i) column[i] *= inverse;
    for (int c = j + 1; c < n; ++c) {
      double* const other = F + std::ptrdiff_t(c) * n;
      if (other[j] != 0) subtract(other[j], column + j + 1, n - j - 1, other + j + 1);
    }
  }
}

std::size_t entries_of_L_and_U(const FrontalPattern::Front& front) {
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

void FrontalLu::eliminate_in_blocks(int k, int* rows, Eigen::Map<Mat>& F) {
  const Index b = F.rows() - k;
  Eigen::Ref<Mat> corner = F.topLeftCorner(k, k);
  const Eigen::PartialPivLU<Eigen::Ref<Mat>> lu(corner);
  const std::vector<int> before(rows, rows + k);
  for (int j = 0; j < k; ++j) rows[lu.permutationP().indices()(j)] = before[std::size_t(j)];
  if (b == 0) return;
  auto right = F.topRightCorner(k, b);
  auto below = F.bottomLeftCorner(b, k);
  right = (lu.permutationP() * right).eval();
  corner.triangularView<Eigen::UnitLower>().solveInPlace(right);
  corner.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
  F.bottomRightCorner(b, b).noalias() -= below * right;
}

bool FrontalLu::eliminate(const FrontalPattern& pattern, const Front& front, const Vec& largest, Eigen::Map<Mat>& F) {
  const int n = front.size, k = front.eliminated, b = n - k;
  int* const rows = exchanged_.data() + front.unknowns;
  const int* const unknowns = pattern.unknowns(front);
  std::copy_n(unknowns, k, rows);
  if (n <= small_front)
    eliminate_columns(F.data(), n, k, rows);
  else
    eliminate_in_blocks(k, rows, F);
  for (int j = 0; j < k; ++j) {
    const double pivot = pivots_(unknowns[j]) = F(j, j);
    if (!(std::abs(pivot) > small_pivot * largest(unknowns[j]))) return false;
  }
  double* const at = store_.data() + stored_;
  stored_ += entries_of_L_and_U(front);
  matrix(at, n, k) = F.leftCols(k);
  matrix(at + n * k, k, b) = F.topRightCorner(k, b);
  matrix(stack_.data() + top_, b, b) = F.bottomRightCorner(b, b);
  top_ += std::size_t(b) * std::size_t(b);
  return true;
}

bool FrontalLu::factorise(const FrontalPattern& pattern, const Sparse& A, const Vec& largest) {
  std::size_t all = 0;
  for (const Front& front : pattern.fronts()) all += entries_of_L_and_U(front);
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

namespace {

// y_F := L_F^-1 y_F,  y_B := -L_BF y_F
void solve_lower(const double* L, int n, int k, Vec& y) {
  y.tail(n - k).setZero();
  if (n <= small_front) {
    for (int j = 0; j < k; ++j, L += n) subtract(y[j], L + j + 1, n - j - 1, y.data() + j + 1);
    return;
  }
  const Eigen::Map<const Mat> left(L, n, k);
  left.topRows(k).triangularView<Eigen::UnitLower>().solveInPlace(y.head(k));
  y.tail(n - k).noalias() -= left.bottomRows(n - k) * y.head(k);
}

// y_F := U_F^-1 (y_F - U_FB y_B); U_FB follows L and U_F in memory.
void solve_upper(const double* U, int n, int k, Vec& y) {
  const double* beside = U + std::ptrdiff_t(n) * k;
  if (n <= small_front) {
    for (int j = k; j < n; ++j, beside += k) subtract(y[j], beside, k, y.data());
    for (int j = k - 1; j >= 0; --j) {
      const double* const column = U + std::ptrdiff_t(n) * j;
      y[j] /= column[j];
      subtract(y[j], column, j, y.data());
    }
    return;
  }
  y.head(k).noalias() -= Eigen::Map<const Mat>(beside, k, n - k) * y.tail(n - k);
  Eigen::Map<const Mat>(U, n, k).topRows(k).triangularView<Eigen::Upper>().solveInPlace(y.head(k));
}

}  // namespace

// L U x = x
void FrontalLu::substitute(const FrontalPattern& pattern, Vec& x) {
  const double* at = store_.data();
  for (const Front& front : pattern.fronts()) {
    const int n = front.size, k = front.eliminated;
    const int *const unknowns = pattern.unknowns(front), *const rows = exchanged_.data() + front.unknowns;
    y_.resize(n);
    for (int i = 0; i < k; ++i) y_(i) = x(rows[i]);
    solve_lower(at, n, k, y_);
    at += entries_of_L_and_U(front);
    for (int i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
    for (int i = k; i < n; ++i) x(unknowns[i]) += y_(i);
  }
  for (auto front = pattern.fronts().rbegin(); front != pattern.fronts().rend(); ++front) {
    const int n = front->size, k = front->eliminated;
    const int* const unknowns = pattern.unknowns(*front);
    at -= entries_of_L_and_U(*front);
    y_.resize(n);
    for (int i = 0; i < n; ++i) y_(i) = x(unknowns[i]);
    solve_upper(at, n, k, y_);
    for (int i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
  }
}

}  // namespace trammel::numerics
