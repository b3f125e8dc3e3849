// In which fronts a sparse matrix is eliminated, and where each of its numbers goes.
//
// The unknowns that a front eliminates (elimination_tree.hpp; F) and its boundary (B) form a dense matrix: their
// entries of A plus the update matrices of the children. It leaves an update matrix on B to the front above. Order and
// places are kept while the pattern lasts: once per mesh of a plate. Unknowns with the same neighbours form one node of
// the tree. An unknown without a diagonal entry, such as a multiplier, joins a node in which its row is large, so that
// their front has a pivot for both. This choice is made for each matrix: the order then depends on the present matrix
// only, and a resumed run rounds like an uninterrupted one. Duff, Reid, ACM Trans. Math. Softw. 9 (1983), 302; 10
// (1984), 633 (unsymmetric).
// (unsymmetric).
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

#include <trammel/types.hpp>

#include "linear/order/elimination_tree.hpp"

namespace trammel::numerics {

class FrontalPattern {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  struct Entry {
    int from, row, column;  // index among A's values; place in the front's matrix
  };
  struct Child {
    std::size_t map;  // place in this front of each unknown of the child's boundary, ascending
    int boundary;     // number of these
  };
  // In the order of elimination: F, then B.
  struct Front {
    int eliminated = 0, size = 0;  // numbers of unknowns: of F; of F and B
    std::size_t unknowns = 0;      // offset in the unknowns of all fronts
    std::size_t entries = 0, entries_end = 0;
    std::vector<Child> children = {};  // the last one first: update matrices are on a stack
    int boundary() const { return size - eliminated; }
  };

  // The pattern is symmetric and includes the diagonal; some entries may be 0. To be called again when the pattern has
  // changed, or no longer fits.
  void analyse(const Sparse& A);
  // For a matrix with the analysed pattern: true if its multipliers are large in the same nodes.
  bool fits(const Sparse& A) const { return find_partners(A) == partners_; }

  const std::vector<Front>& fronts() const { return fronts_; }  // children first, each right after its last child
  std::size_t all_unknowns() const { return unknowns_.size(); }
  int largest() const { return largest_; }                    // unknowns of the largest front
  std::size_t most_waiting() const { return most_waiting_; }  // largest number of stacked entries of update matrices
  const int* unknowns(const Front& front) const { return unknowns_.data() + front.unknowns; }
  const int* map(const Child& child) const { return maps_.data() + child.map; }
  // Calls f(entry) for all entries of A whose row or column this front is the first to eliminate.
  template <class F>
  void each_entry(const Front& front, F&& f) const {
    for (std::size_t e = front.entries; e < front.entries_end; ++e) f(entries_[e]);
  }

 private:
  std::vector<int> find_partners(const Sparse& A) const;
  void lay_out(const EliminationTree& tree, const std::vector<std::vector<int>>& members, Eigen::Index n);
  void place_entries(const Sparse& A);

  std::vector<int> nodes_;     // of each unknown, named by one of its unknowns
  std::vector<int> partners_;  // of each unknown with a 0 on the diagonal
  std::vector<Front> fronts_;
  std::vector<int> unknowns_;
  std::vector<Entry> entries_;
  std::vector<int> maps_;
  int largest_ = 0;
  std::size_t most_waiting_ = 0;
};

}  // namespace trammel::numerics
