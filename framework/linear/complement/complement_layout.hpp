// In which fronts the rows of bodies are eliminated from G M^-1 G^T, and where each number of a body's block goes.
//
// A body couples all rows that touch it: its block is added to the front (elimination_tree.hpp) that eliminates the
// first of them. Rows between the same bodies, such as those of a joint, form one node of the tree. The layout depends
// only on which rows touch which bodies.
//
// The data of fronts lie in memory in the order of use, so that long chains are read contiguously.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linear/bodies/body_block.hpp"
#include "linear/dense/simd_columns.hpp"

namespace trammel::numerics {

class ComplementLayout {
 public:
  struct List {
    std::size_t begin = 0, count = 0;
  };
  // A contribution of a body or a child to a front: a matrix on some of its rows, in the order of elimination.
  struct Share {
    int of = 0;   // body, or front
    List order;   // indices of these rows among the body's rows
    List places;  // their indices in the front
  };
  // A front's matrix has a column for each row of G that it eliminates (L), then one for each row of its boundary (R),
  // all padded to whole SIMD packs (simd_columns.hpp). The memory of R is reused by other fronts after the parent has
  // added it, so that it stays in the cache.
  struct Front {
    int eliminated = 0, size = 0;
    List rows, bodies, children;
    std::size_t L = 0, R = 0;  // offset of its numbers among those of all fronts
    Eigen::Index stride() const { return padded(size); }
  };

  // True if the layout was made for the first nc rows of these bodies.
  bool is_built_for(const std::vector<BodyBlock>& bodies, int nc) const;
  void find(const std::vector<BodyBlock>& bodies, int nc);

  const std::vector<Front>& fronts() const { return fronts_; }                                // children first
  std::span<const int> rows(const Front& front) const { return part(numbers_, front.rows); }  // of G
  std::span<const Share> bodies(const Front& front) const { return part(shares_, front.bodies); }
  std::span<const Share> children(const Front& front) const { return part(shares_, front.children); }
  std::span<const int> order(const Share& share) const { return part(numbers_, share.order); }
  std::span<const int> places(const Share& share) const { return part(numbers_, share.places); }
  std::size_t numbers_L() const { return L_; }
  std::size_t numbers_R() const { return R_; }
  int largest() const { return largest_; }  // front

 private:
  template <class T>
  static std::span<const T> part(const std::vector<T>& of, List list) {
    return {of.data() + list.begin, list.count};
  }
  void take_rows(const std::vector<BodyBlock>& bodies, int nc);
  Front& add_front(std::vector<int> eliminated, const std::vector<int>& boundary, const std::vector<int>& bodies,
                   const std::vector<int>& children);
  List keep(const std::vector<int>& numbers);
  void place_shares(Front& front, const std::vector<int>& bodies, const std::vector<int>& children);

  int nc_ = -1;
  std::vector<Front> fronts_;
  std::vector<Share> shares_;
  std::vector<int> numbers_;
  std::vector<List> of_bodies_;  // in rows_
  std::vector<int> rows_;
  std::vector<int> place_;  // index of a row in the present front
  std::size_t L_ = 0, R_ = 0;
  int largest_ = 0;
};

}  // namespace trammel::numerics
