#include "linear/dense/block_signs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "linear/dense/lu.hpp"

namespace trammel::numerics {

int BlockSigns::root(int row) const {
  while (parent_[std::size_t(row)] != row) row = parent_[std::size_t(row)];
  return row;
}

void BlockSigns::join(int a, int b) {
  a = root(a), b = root(b);
  if (a == b) return;
  const auto [first, other] = std::minmax(a, b);
  parent_[std::size_t(other)] = first;
  sign_[std::size_t(first)] *= sign_[std::size_t(other)];
}

// Pivoting by rows exchanges no rows of different blocks, since a column is 0 outside its own block.
void BlockSigns::find(const Mat& A, const Lu& factors, double least_pivot) {
  const auto n = std::size_t(A.rows());
  parent_.resize(n);
  std::iota(parent_.begin(), parent_.end(), 0);
  sign_.assign(n, 1);
  for (int j = 0; j < int(n); ++j)
    for (int i = 0; i < int(n); ++i)
      if (A(i, j) != 0) join(i, j);
  for (int i = 0; i < int(n); ++i) parent_[std::size_t(i)] = root(i);
  const std::vector<Eigen::Index> rows = factors.rows();
  for (int j = 0; j < int(n); ++j) {
    const int block = parent_[std::size_t(j)];
    int& sign = sign_[std::size_t(block)];
    if (factors.is_small_pivot(A, least_pivot, j)) sign = 0;
    if (factors.pivot(j) < 0) sign = -sign;
    for (int i = block; i < j; ++i)
      if (parent_[std::size_t(i)] == block && rows[std::size_t(j)] < rows[std::size_t(i)]) sign = -sign;
  }
}

void BlockSigns::flip(const std::vector<int>& rows) {
  for (const int row : rows) join(rows.front(), row);
  if (!rows.empty()) sign_[std::size_t(root(rows.front()))] *= -1;
}

bool any_opposite(const BlockSigns& a, const BlockSigns& b) {
  if (a.parent_.size() != b.parent_.size()) return false;
  BlockSigns both = a;
  for (int i = 0; i < int(b.parent_.size()); ++i) both.join(i, b.parent_[std::size_t(i)]);
  for (int i = 0; i < int(b.parent_.size()); ++i)
    if (b.parent_[std::size_t(i)] == i) both.sign_[std::size_t(both.root(i))] *= b.sign_[std::size_t(i)];
  for (int i = 0; i < int(both.parent_.size()); ++i)
    if (both.parent_[std::size_t(i)] == i && both.sign_[std::size_t(i)] < 0) return true;
  return false;
}

void BlockSigns::archive(Archive& a, std::string_view name) {
  const auto n = Eigen::Index(parent_.size());
  Vec flat(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) flat[i] = parent_[std::size_t(i)], flat[n + i] = sign_[std::size_t(i)];
  a(name, flat);
  const Eigen::Index rows = flat.size() / 2;
  parent_.clear(), sign_.clear();
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (!(flat[i] >= 0 && flat[i] <= double(i) && std::abs(flat[rows + i]) <= 1))
      throw std::out_of_range(std::string(name) + ": no block of this row");
    parent_.push_back(int(flat[i])), sign_.push_back(int(flat[rows + i]));
  }
}

}  // namespace trammel::numerics
