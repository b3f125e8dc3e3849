// L D L^T of a sparse symmetric positive semidefinite matrix A plus what makes it definite.
//
//     P (A + E) P^T = L D L^T,    d_k = a_kk - sum_i l_ki^2 d_i        P approximate minimum degree, found once for a pattern
//
// A pivot of d_k <= tolerance a_kk, the square of a sine of an angle where A is a Gram matrix, is a row that depends on those
// before: a_kk takes its place, so E is diagonal and has as many entries as there are dependent rows. Then A + E has no other
// eigenvalue on the range of A than A itself: (A + E)^-1 A x = x for all x with E x = 0, and conjugate gradients preconditioned by
// it end after one step but for round-off, where a shift A + eps would blur all directions softer than eps.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include <trammel/types.hpp>

namespace trammel::numerics {

class SemidefiniteLdlt {
 public:
  using Sparse = Eigen::SparseMatrix<double>;  // its lower triangle counts

  void analyse(const Sparse& A);
  void factorise(const Sparse& A, double tolerance);  // of the pattern analysed
  void solve(Vec& x);                                 // (A + E)^-1 x in place
  const std::vector<int>& dependent() const { return dependent_; }

 private:
  int n_ = 0;
  std::vector<int> order_, place_;             // order_[k]: row of A at k; place_ its inverse
  std::vector<int> begin_, row_, source_;      // upper triangle of P A P^T by columns; entry's index in A's values
  std::vector<int> parent_, column_, filled_;  // elimination tree; columns of L: begin, entries so far
  std::vector<int> L_row_;
  std::vector<double> L_, inverse_;  // 1/d
  std::vector<int> mark_, stack_, path_;
  std::vector<double> work_;
  std::vector<int> dependent_;
};

}  // namespace trammel::numerics
