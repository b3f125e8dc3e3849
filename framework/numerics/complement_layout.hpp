// In which fronts the rows of bodies are eliminated from G M^-1 G^T, and where each number of a body's share goes.
//
// A body couples all rows that touch it: its share goes to the front (elimination_tree.hpp) that eliminates the first of them.
// Rows between the same bodies, as those of a joint, make one node of the tree. Follows from which rows touch which bodies alone.
#pragma once

#include <cstddef>
#include <vector>

#include "numerics/body_block.hpp"
#include "numerics/packs.hpp"

namespace trammel::numerics {

class ComplementLayout {
 public:
  // A front's matrix has a column for each row of G it eliminates, and then for each of its boundary, in whole packs (packs.hpp).
  struct Front {
    int eliminated = 0, size = 0;
    std::vector<int> rows = {};                   // of G
    std::vector<int> bodies = {}, children = {};  // whose shares, and whose boundaries it takes
    std::size_t L = 0, U = 0;                     // where its numbers begin in those of all fronts
    Eigen::Index stride() const { return padded(size); }
    Eigen::Index stride_above() const { return padded(eliminated); }  // of a column of U
  };

  // Of the first nc rows.
  bool holds(const std::vector<BodyBlock>& bodies, int nc) const;
  void find(const std::vector<BodyBlock>& bodies, int nc);

  const std::vector<Front>& fronts() const { return fronts_; }  // children first
  // Of the body's rows, in the order of elimination: which of the body's, and of G.
  const std::vector<int>& order(int body) const { return order_[std::size_t(body)]; }
  const std::vector<int>& rows(int body) const { return ordered_rows_[std::size_t(body)]; }
  // They are the front's first ones.
  bool leads(int body) const { return leads_[std::size_t(body)]; }
  // In the matrix of the front that takes them: of the lower triangle of a body's share, column by column; of a boundary's rows.
  const std::vector<int>& slots(int body) const { return slots_[std::size_t(body)]; }
  const std::vector<int>& places(int child) const { return places_[std::size_t(child)]; }
  std::size_t numbers_L() const { return L_; }
  std::size_t numbers_U() const { return U_; }
  int largest() const { return largest_; }  // front

 private:
  void place_shares(const std::vector<int>& front_of);
  void place_boundaries();

  int nc_ = -1;
  std::vector<Front> fronts_;
  std::vector<std::vector<int>> rows_, order_, ordered_rows_, slots_, places_;
  std::vector<char> leads_;
  std::size_t L_ = 0, U_ = 0;
  int largest_ = 0;
};

}  // namespace trammel::numerics
