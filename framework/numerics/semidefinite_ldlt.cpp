#include "numerics/semidefinite_ldlt.hpp"

#include <algorithm>

#include <Eigen/OrderingMethods>

namespace trammel::numerics {

// Row k of L has its entries on the paths from the entries of column k of the upper triangle towards the root of the elimination
// tree (Liu 1990), which gives the tree, the columns' lengths and, in `factorise`, the order of the elimination.
void SemidefiniteLdlt::analyse(const Sparse& A) {
  n_ = int(A.rows());
  const auto n = std::size_t(n_);
  Sparse full = A.selfadjointView<Eigen::Lower>();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(full, permutation);
  order_.assign(permutation.indices().data(), permutation.indices().data() + n_);
  place_.resize(n);
  for (int k = 0; k < n_; ++k) place_[std::size_t(order_[std::size_t(k)])] = k;

  begin_.assign(n + 1, 0);
  const auto each_entry = [&](auto&& visit) {
    for (int j = 0; j < n_; ++j)
      for (int p = A.outerIndexPtr()[j]; p < A.outerIndexPtr()[j + 1]; ++p) {
        const int i = A.innerIndexPtr()[p];
        if (i < j) continue;
        const auto [low, high] = std::minmax(place_[std::size_t(i)], place_[std::size_t(j)]);
        visit(std::size_t(high), low, p);
      }
  };
  each_entry([&](std::size_t column, int, int) { ++begin_[column + 1]; });
  for (std::size_t k = 0; k < n; ++k) begin_[k + 1] += begin_[k];
  row_.resize(std::size_t(begin_[n])), source_.resize(row_.size());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  each_entry([&](std::size_t column, int row, int p) {
    const auto at = std::size_t(next[column]++);
    row_[at] = row, source_[at] = p;
  });

  parent_.assign(n, -1);
  mark_.assign(n, -1);
  std::vector<int> length(n, 0);
  for (int k = 0; k < n_; ++k) {
    mark_[std::size_t(k)] = k;
    for (int p = begin_[std::size_t(k)]; p < begin_[std::size_t(k) + 1]; ++p)
      for (int i = row_[std::size_t(p)]; mark_[std::size_t(i)] != k; i = parent_[std::size_t(i)]) {
        if (parent_[std::size_t(i)] < 0) parent_[std::size_t(i)] = k;
        ++length[std::size_t(i)];
        mark_[std::size_t(i)] = k;
      }
  }
  column_.assign(n + 1, 0);
  for (std::size_t k = 0; k < n; ++k) column_[k + 1] = column_[k] + length[k];
  L_row_.resize(std::size_t(column_[n])), L_.resize(L_row_.size());
  inverse_.resize(n), filled_.resize(n), stack_.resize(n), path_.resize(n), work_.assign(n, 0.0);
}

void SemidefiniteLdlt::factorise(const Sparse& A, double tolerance) {
  const double* const values = A.valuePtr();
  dependent_.clear();
  std::fill(mark_.begin(), mark_.end(), -1);
  std::copy(column_.begin(), column_.end() - 1, filled_.begin());
  for (int k = 0; k < n_; ++k) {
    // Column k of the upper triangle, and its path entries, nearest to the leaves first.
    double diagonal = 0;
    int top = n_;
    mark_[std::size_t(k)] = k;
    for (int p = begin_[std::size_t(k)]; p < begin_[std::size_t(k) + 1]; ++p) {
      const int row = row_[std::size_t(p)];
      const double value = values[source_[std::size_t(p)]];
      if (row == k) {
        diagonal += value;
        continue;
      }
      work_[std::size_t(row)] += value;
      int length = 0;
      for (int i = row; mark_[std::size_t(i)] != k; i = parent_[std::size_t(i)]) {
        path_[std::size_t(length++)] = i;
        mark_[std::size_t(i)] = k;
      }
      while (length > 0) stack_[std::size_t(--top)] = path_[std::size_t(--length)];
    }

    double pivot = diagonal;
    for (; top < n_; ++top) {
      const auto i = std::size_t(stack_[std::size_t(top)]);
      const double y = work_[i], l = y * inverse_[i];
      work_[i] = 0;
      const auto end = std::size_t(filled_[i]++);
      L_row_[end] = k;
      L_[end] = l;
      for (auto p = std::size_t(column_[i]); p < end; ++p) work_[std::size_t(L_row_[p])] -= L_[p] * y;
      pivot -= l * y;
    }
    const bool depends = !(pivot > tolerance * diagonal);
    inverse_[std::size_t(k)] = 1 / (depends ? diagonal : pivot);
    if (depends) dependent_.push_back(order_[std::size_t(k)]);
  }
}

void SemidefiniteLdlt::solve(Vec& x) {
  for (int k = 0; k < n_; ++k) work_[std::size_t(k)] = x(order_[std::size_t(k)]);
  for (std::size_t k = 0; k < std::size_t(n_); ++k) {
    for (int p = column_[k]; p < column_[k + 1]; ++p)
      work_[std::size_t(L_row_[std::size_t(p)])] -= L_[std::size_t(p)] * work_[k];
  }
  for (std::size_t k = std::size_t(n_); k-- > 0;) {
    double y = work_[k] * inverse_[k];
    for (int p = column_[k]; p < column_[k + 1]; ++p)
      y -= L_[std::size_t(p)] * work_[std::size_t(L_row_[std::size_t(p)])];
    work_[k] = y;
  }
  for (std::size_t k = 0; k < std::size_t(n_); ++k) x(order_[k]) = work_[k], work_[k] = 0;
}

}  // namespace trammel::numerics
