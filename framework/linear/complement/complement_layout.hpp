// In which fronts the rows of bodies are eliminated from G M^-1 G^T, and where each number of a body's share goes.
//
// A body couples all rows that touch it: its share goes to the front (elimination_tree.hpp) that eliminates the first
// of them. Rows between the same bodies, as those of a joint, make one node of the tree. Follows from which rows touch
// which bodies alone.
//
// What fronts need lies in memory in the order of use: long chains are read from end to end.
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
  // What a body or a child adds to a front: a matrix on some of its rows, in the order of elimination.
  struct Share {
    int of = 0;   // body, or front
    List order;   // which of the body's rows they are
    List places;  // which of the front's
  };
  // A front's matrix has a column for each row of G it eliminates, L, and then for each of its boundary, R; all in
  // whole packs (packs.hpp). R's place serves other fronts once the parent has taken it: it stays in the cache.
  struct Front {
    int eliminated = 0, size = 0;
    List rows, bodies, children;
    std::size_t L = 0, R = 0;  // where its numbers begin in those of all fronts
    Eigen::Index stride() const { return padded(size); }
  };

  // Of the first nc rows.
  bool holds(const std::vector<BodyBlock>& bodies, int nc) const;
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
  List keep(const std::vector<int>& numbers);
  void place_shares(Front& front, const std::vector<int>& bodies, const std::vector<int>& children);

  int nc_ = -1;
  std::vector<Front> fronts_;
  std::vector<Share> shares_;
  std::vector<int> numbers_;
  std::vector<List> of_bodies_;  // in rows_
  std::vector<int> rows_;
  std::vector<int> place_;  // of a row in the front at hand
  std::size_t L_ = 0, R_ = 0;
  int largest_ = 0;
};

}  // namespace trammel::numerics
