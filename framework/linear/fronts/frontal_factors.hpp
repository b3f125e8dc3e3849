// Factors of a large sparse matrix, and solutions that satisfy its equations to round-off.
//
// By Cholesky's method if A is symmetric and positive definite, otherwise by LU. A sum of blocks is symmetric up to the
// rounding of the sum, and this is tolerated. Both the choice and a small pivot affect only the work: a solution is
// corrected by the residual with A itself until that is round-off; if it does not become so, `solve` returns false.
#pragma once

#include "linear/fronts/frontal_cholesky.hpp"
#include "linear/fronts/frontal_lu.hpp"
#include "linear/fronts/frontal_pattern.hpp"

namespace trammel::numerics {

class FrontalFactors {
 public:
  using Sparse = FrontalPattern::Sparse;
  // To be called again when the pattern has changed (see FrontalPattern::analyse).
  void analyse(const Sparse& A) { pattern_.analyse(A); }
  bool fits(const Sparse& A) const { return pattern_.fits(A); }
  // False: a pivot of a front is round-off beside its column of A, or not finite.
  [[nodiscard]] bool factorise(const Sparse& A);
  // Not in place; A is the one that was factorised. False: x does not satisfy the equations.
  [[nodiscard]] bool solve(const Sparse& A, const Vec& b, Vec& x);
  bool by_cholesky() const { return by_cholesky_; }
  double pivot(Eigen::Index j) const { return lu_.pivot(j); }   // of A's column j, by LU
  double largest(Eigen::Index j) const { return largest_(j); }  // |entry| of that column

 private:
  void measure(const Sparse& A);
  bool may_be_definite(const Sparse& A);
  void substitute(Vec& x);

  FrontalPattern pattern_;
  FrontalCholesky cholesky_;
  FrontalLu lu_;
  bool by_cholesky_ = false;
  Vec largest_, residual_;
  std::vector<int> mirrored_;  // scratch
};

}  // namespace trammel::numerics
