// P A = L U of a large sparse matrix by elimination in fronts, and the solves with it.
//
// A front's unknowns (frontal_pattern.hpp; F), with its boundary (B):
//
//     [A_FF A_FB]  =  [L_F      ] [U_F  U_FB]       row exchanges within F only;  S goes to the front above
//     [A_BF A_BB]     [L_BF   1 ] [      S  ]
//
// Exchanges within F only may meet a small pivot although A is regular: solutions have to be corrected by their
// residuals (frontal_factors.hpp).
#pragma once

#include "linear/fronts/frontal_pattern.hpp"

namespace trammel::numerics {

class FrontalLu {
 public:
  using Sparse = FrontalPattern::Sparse;
  // `largest`: |entry| of each column of A. False: a pivot of a front is round-off beside its column of A, or not
  // finite.
  [[nodiscard]] bool factorise(const FrontalPattern& pattern, const Sparse& A, const Vec& largest);
  double pivot(Eigen::Index j) const { return pivots_(j); }  // of A's column j
  void substitute(const FrontalPattern& pattern, Vec& x);    // x := A^-1 x

 private:
  using Front = FrontalPattern::Front;
  void assemble(const FrontalPattern& pattern, const Front& front, const double* values, Eigen::Map<Mat>& F);
  void eliminate_in_blocks(int k, int* rows, Eigen::Map<Mat>& F);
  bool eliminate(const FrontalPattern& pattern, const Front& front, const Vec& largest, Eigen::Map<Mat>& F);

  // Aligned like Eigen's own storage, so that sums over parts of them round alike in every run. store_: for each front
  // L_F and U_F over L_BF, then U_FB. stack_: update matrices S that no parent has added yet.
  Vec store_, work_, stack_;
  std::size_t stored_ = 0, top_ = 0;
  std::vector<int> exchanged_;  // by front: the row of F at each place
  Vec pivots_, y_;
};

}  // namespace trammel::numerics
