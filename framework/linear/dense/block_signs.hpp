// Signs of the determinants of the blocks of a matrix that is block diagonal in some order of its rows, its columns
// ordered alike. The sign of the whole determinant does not show that two blocks have changed theirs.
#pragma once

#include <string_view>
#include <vector>

#include <trammel/archive.hpp>
#include <trammel/types.hpp>

namespace trammel::numerics {

class Lu;

class BlockSigns {
 public:
  void clear() { parent_.clear(), sign_.clear(); }  // nothing is known
  bool any() const { return !sign_.empty(); }
  // From factors of A. A pivot up to `least_pivot` times the largest entry of its column leaves its block unknown.
  void find(const Mat& A, const Lu& factors, double least_pivot);
  void flip(const std::vector<int>& rows);  // of the block of these rows, which may have been several blocks
  int of_row(int row) const { return sign_[std::size_t(root(row))]; }  // of its block; 0: unknown
  // True if the determinants of one block have opposite signs. Rows are in one block if they are in a or in b.
  friend bool any_opposite(const BlockSigns& a, const BlockSigns& b);

  void archive(Archive& a, std::string_view name);

 private:
  int root(int row) const;
  void join(int a, int b);

  std::vector<int> parent_;  // by row: an earlier one of its block, or itself
  std::vector<int> sign_;    // by row without an earlier one: of its block
};

}  // namespace trammel::numerics
