// The saddle-point systems of constrained dynamics, dense:
//
//     [S W^T] [x]   [b]
//     [G  0 ] [y] = [c]        S: nv x nv, G and W: nc x nv
//
// Two factorisations, by what S is:
//  - Mass: S = M symmetric positive definite. Cholesky of M and of the Schur complement G M^-1 G^T. Redundant rows
//    are found by the complement's pivots and then solved by a complete orthogonal decomposition of L^-1 G^T: x stays
//    unique, y is the one of minimum norm, and the condition number is not squared. With W other than G (sliding
//    friction) the complement G M^-1 W^T is factorised as it is, by LU, redundant or singular ones orthogonally.
//  - Iteration: S any matrix. LU of the whole with row pivoting; if it is singular, the minimum-norm solution.
// Storage is kept from one factorisation to the next: no allocation at constant sizes while rows are independent.
#pragma once

#include <Eigen/QR>

#include <trammel/types.hpp>

#include "numerics/cholesky.hpp"
#include "numerics/lu.hpp"

namespace trammel::numerics {

class MassKkt {
 public:
  // False: M is not positive definite. `G` may have no rows.
  bool factorise(const Mat& M, const Mat& G, const Mat& W);
  bool factorise(const Mat& M, const Mat& G) { return factorise(M, G, G); }
  // Keeps the factors of M, takes new rows. W may be the same object as G.
  void change_rows(const Mat& G, const Mat& W);
  void change_rows(const Mat& G) { change_rows(G, G); }
  void solve(const Vec& b, const Vec& c, Vec& x, Vec& y);
  bool redundant() const { return redundant_; }

 private:
  Cholesky mass_;
  void complement(const Mat& W);

  Mat B_;      // L^-1 G^T (nv x nc)
  Mat C_;      // L^-1 W^T, where W is not G
  Mat schur_;  // B^T B or B^T C
  Lu schur_lu_;
  Cholesky schur_cholesky_;
  Eigen::CompleteOrthogonalDecomposition<Mat> cod_;
  Vec w_;
  bool redundant_ = false, coupled_ = false;
};

class IterationKkt {
 public:
  // The caller fills S() (nv x nv, zero on entry) after `begin` and then calls `factorise`.
  Mat& begin(Eigen::Index nv, Eigen::Index nc);
  void factorise(const Mat& W, const Mat& G);
  // False: not solvable (singular beyond redundant rows), or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);

 private:
  Mat full_;
  Lu lu_;
  Eigen::CompleteOrthogonalDecomposition<Mat> cod_;
  Vec right_, solution_;
  Eigen::Index nv_ = 0;
  bool singular_ = false, finite_ = true;
};

}  // namespace trammel::numerics
