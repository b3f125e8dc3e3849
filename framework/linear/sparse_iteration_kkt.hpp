// The saddle-point system of any sparse S and W, by a sparse LU with partial pivoting of the whole:
//
//     [S W^T] [x]   [b]
//     [G -eps] [y] = [c]       eps: beside the sizes of S and G; residuals of the unchanged equations are corrected
//
// This is a proximal point iteration: its steps lie in the range of the rows, so y comes out as the one of minimum
// norm, and directions of the rows with sigma^2 < eps count as redundant. x is unique.
//
// Soft rows, few and independent of the others by no more than about the square root of eps: a truss on its way through
// a singular position. Their round-off, over that little, would move x by more than it is worth, differently each time,
// so that Newton's iteration finds no end. They are taken for redundant too: x does not satisfy them, and y does not
// act along them.
#pragma once

#include <Eigen/SparseLU>

#include <trammel/types.hpp>

namespace trammel::numerics {

class SparseIterationKkt {
 public:
  // Of [S W^T; G 0], given as a whole. False: singular beyond redundant rows, or not finite.
  bool factorise(const Eigen::SparseMatrix<double>& full, int nv);
  // False: not solvable, or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);

 private:
  void find_null_part(const Eigen::Ref<const Vec>& y);
  void judge_rows(int nc);
  void minimise_norm(int nc);
  // With right_, filling solution_ and residual_, whose norm is returned.
  double solve_and_refine();
  double solve_without_soft_rows(int nc);

  Eigen::SparseMatrix<double> full_, regular_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
  int nv_ = 0;
  double eps_ = 0;  // in the corner
  bool failed_ = false;
  bool redundant_ = false;  // some of few rows are
  bool soft_ = false;       // some are but for a little
  int solves_ = 0;          // that solution_ is a sum of
  Vec right_, solution_, residual_, correction_;
  Vec null_part_;  // of multipliers, and less what they do to x
};

}  // namespace trammel::numerics
