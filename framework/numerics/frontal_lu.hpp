// P A = L U of a large matrix most of whose entries are 0, front by front, and the solves with it.
//
// The unknowns of one front (elimination_tree.hpp; F), with its boundary (B), make a dense matrix: their entries of A and what the
// fronts below leave,
//
//     [A_FF A_FB]  =  [L_F      ] [U_F  U_FB]       rows are exchanged within F;  S goes to the front above
//     [A_BF A_BB]     [L_BF   1 ] [      S  ]
//
// Order and places follow from the pattern alone and are kept while it lasts: once per mesh of a plate. Unknowns with the same neighbours make one node of the tree. One without a diagonal entry, a multiplier of a row, shares the
// node of an unknown in its row, so that their front has a pivot for both.
// Exchanges within F alone may meet a small pivot where A is regular: a solution is corrected with the residual until that is
// round-off, and where it does not become so this says no.
// Duff, Reid, ACM Trans. Math. Softw. 9 (1983), 302; 10 (1984), 633 (unsymmetric).
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

#include <trammel/types.hpp>

#include "numerics/elimination_tree.hpp"

namespace trammel::numerics {

class FrontalLu {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  // The pattern is symmetric and has the diagonal; some entries may be 0. Numbers decide only which unknown's node takes one that
  // has 0 there. To be called again when the pattern has changed.
  void analyse(const Sparse& A);
  // False: a pivot of a front is round-off beside its column of A, or not finite.
  [[nodiscard]] bool factorise(const Sparse& A);
  double pivot(Eigen::Index j) const { return pivots_(j); }  // of A's column j
  double largest(Eigen::Index j) const { return largest_(j); }
  // Not in place; A is the one that was factorised. False: exchanges within fronts were not enough, x does not satisfy the equations.
  [[nodiscard]] bool solve(const Sparse& A, const Vec& b, Vec& x);
  std::size_t stored() const { return std::size_t(store_.size()); }  // numbers in the factors

 private:
  struct Entry {
    int from, to;  // of A's values, in the front's matrix
  };
  struct Range {
    std::size_t begin, end;
  };
  struct Front {
    int eliminated, size;           // unknowns: of F; of F and B
    std::size_t unknowns;           // in unknowns_
    std::size_t factors;            // in store_: L_F and U_F over L_BF, then U_FB
    Range entries;                  // in entries_
    std::vector<std::size_t> maps;  // of each child, in maps_: this front's place of each unknown of its boundary
    std::vector<int> boundaries;    // of each child: how many these are
    int boundary() const { return size - eliminated; }
  };

  static std::vector<int> find_nodes(const Sparse& A);
  void lay_out(const EliminationTree& tree, const std::vector<std::vector<int>>& members, Eigen::Index n);
  void place_entries(const Sparse& A);
  void measure(const Sparse& A);
  void assemble(const Front& front, const double* values, Eigen::Map<Mat>& F);
  bool eliminate(const Front& front, Eigen::Map<Mat>& F);
  void substitute(Vec& x);

  Vec largest_;                // |entry| of each column
  std::vector<Front> fronts_;  // children first, each right after its last child
  std::vector<int> unknowns_;
  std::vector<Entry> entries_;
  std::vector<int> maps_;
  // Aligned as Eigen's own: sums over pieces of them then round alike in every run. stack_: what fronts leave to those above, still
  // to be taken.
  Vec store_, work_, stack_;
  std::size_t top_ = 0;
  std::vector<int> exchanged_;  // by place in unknowns_: which row of F comes there
  Vec pivots_, y_, residual_;
};

}  // namespace trammel::numerics
