// P A P^T = L L^T for a large sparse symmetric positive definite matrix, by elimination in fronts, and the solves with
// it.
//
// A front's unknowns (frontal_pattern.hpp; F), with its boundary (B):
//
//     [A_FF A_FB]  =  [L_FF  ] [L_FF^T L_BF^T]       S goes to the front above
//     [A_BF A_BB]     [L_BF 1] [            S]
//
// Half of the work and of the memory of frontal_lu.hpp. Reads and stores lower triangles only.
#pragma once

#include "linear/fronts/frontal_pattern.hpp"

namespace trammel::numerics {

class FrontalCholesky {
 public:
  using Sparse = FrontalPattern::Sparse;
  // `largest`: |entry| of each column of A. False: not positive definite by more than round-off, or not finite.
  [[nodiscard]] bool factorise(const FrontalPattern& pattern, const Sparse& A, const Vec& largest);
  void substitute(const FrontalPattern& pattern, Vec& x);  // x := A^-1 x

 private:
  using Front = FrontalPattern::Front;
  void assemble(const FrontalPattern& pattern, const Front& front, const double* values);
  void keep(const Front& front);

  // Aligned like Eigen's own storage, so that sums over parts of them round alike in every run. stack_: update matrices
  // S that no parent has added yet.
  Vec store_, work_, stack_, y_;
  std::size_t stored_ = 0, top_ = 0;
};

}  // namespace trammel::numerics
