#include "linear/fronts/frontal_cholesky.hpp"

#include <algorithm>
#include <limits>

#include "linear/dense/partial_cholesky.hpp"

namespace trammel::numerics {

namespace {

using Index = Eigen::Index;

constexpr double small_root = 64 * std::numeric_limits<double>::epsilon();

std::size_t entries_of_L(const FrontalPattern::Front& front) {
  return std::size_t(front.size) * std::size_t(front.eliminated);
}

}  // namespace

void FrontalCholesky::assemble(const FrontalPattern& pattern, const Front& front, const double* values) {
  const Index stride = column_stride(front.size);
  double* const F = work_.data();
  for (Index j = 0; j < front.size; ++j) std::fill(F + j * stride + j, F + (j + 1) * stride, 0.0);
  pattern.each_entry(front, [&](const FrontalPattern::Entry& entry) {
    if (entry.row >= entry.column) F[entry.column * stride + entry.row] = values[entry.from];
  });
  for (const FrontalPattern::Child& child : front.children) {
    const int n = child.boundary, *const map = pattern.map(child);
    top_ -= std::size_t(n) * std::size_t(n);
    const double* from = stack_.data() + top_;
    for (int j = 0; j < n; ++j, from += n) {
      double* const column = F + map[j] * stride;
      for (int i = j; i < n; ++i) column[map[i]] += from[i];
    }
  }
}

// Stores L_FF and L_BF in store_, and S on the stack.
void FrontalCholesky::keep(const Front& front) {
  const Index n = front.size, k = front.eliminated, stride = column_stride(n);
  const double* column = work_.data();
  double* to = store_.data() + stored_;
  for (Index j = 0; j < k; ++j, column += stride, to += n) std::copy(column + j, column + n, to + j);
  stored_ += entries_of_L(front);
  to = stack_.data() + top_;
  for (Index j = k; j < n; ++j, column += stride, to += n - k) std::copy(column + j, column + n, to + j - k);
  top_ += std::size_t(n - k) * std::size_t(n - k);
}

bool FrontalCholesky::factorise(const FrontalPattern& pattern, const Sparse& A, const Vec& largest) {
  std::size_t all = 0;
  for (const Front& front : pattern.fronts()) all += entries_of_L(front);
  store_.resize(Index(all));
  work_.resize(pattern.largest() * column_stride(pattern.largest()));
  stack_.resize(Index(pattern.most_waiting()));
  stored_ = top_ = 0;
  for (const Front& front : pattern.fronts()) {
    assemble(pattern, front, A.valuePtr());
    if (!partial_cholesky(work_.data(), front.size, front.eliminated)) return false;
    const int* const unknowns = pattern.unknowns(front);
    for (int j = 0; j < front.eliminated; ++j) {
      const double root = work_(j * column_stride(front.size) + j);
      if (!(root * root > small_root * largest(unknowns[j]))) return false;
    }
    keep(front);
  }
  return true;
}

void FrontalCholesky::substitute(const FrontalPattern& pattern, Vec& x) {
  using Factors = Eigen::Map<const Mat>;
  const std::vector<Front>& fronts = pattern.fronts();
  y_.resize(pattern.largest());
  const double* at = store_.data();
  for (const Front& front : fronts) {
    const Index n = front.size, k = front.eliminated;
    const int* const unknowns = pattern.unknowns(front);
    const Factors L(at, n, k);
    for (Index i = 0; i < k; ++i) y_(i) = x(unknowns[i]);
    L.topRows(k).triangularView<Eigen::Lower>().solveInPlace(y_.head(k));
    y_.segment(k, n - k).noalias() = L.bottomRows(n - k) * y_.head(k);
    for (Index i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
    for (Index i = k; i < n; ++i) x(unknowns[i]) -= y_(i);
    at += entries_of_L(front);
  }
  for (auto front = fronts.rbegin(); front != fronts.rend(); ++front) {
    const Index n = front->size, k = front->eliminated;
    const int* const unknowns = pattern.unknowns(*front);
    at -= entries_of_L(*front);
    const Factors L(at, n, k);
    for (Index i = 0; i < n; ++i) y_(i) = x(unknowns[i]);
    y_.head(k).noalias() -= L.bottomRows(n - k).transpose() * y_.segment(k, n - k);
    L.topRows(k).transpose().triangularView<Eigen::Upper>().solveInPlace(y_.head(k));
    for (Index i = 0; i < k; ++i) x(unknowns[i]) = y_(i);
  }
}

}  // namespace trammel::numerics
