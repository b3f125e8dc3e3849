// The saddle-point system of any sparse S and W, by a sparse LU with partial pivoting of the whole:
//
//     [S W^T] [x]   [b]
//     [G -eps] [y] = [c]       eps: relative to the sizes of S and G; corrected by residuals of the unchanged equations
//
// This is a proximal point iteration. Its steps lie in the range of the rows, so y is of minimum norm, and directions
// of the rows with sigma^2 < eps count as redundant. x is unique.
//
// Nearly dependent rows (a few, independent of the others by no more than about the square root of eps, as in a truss
// near a singular position) also count as redundant. Otherwise their round-off, divided by that small value, would
// change x too much and differently each time, so that Newton's iteration could not end. x does not satisfy them, and y
// does not act along them.
#pragma once

#include <Eigen/SparseLU>

#include <trammel/types.hpp>

namespace trammel::numerics {

class SparseIterationKkt {
 public:
  // For [S W^T; G 0] as a whole. False: singular beyond redundant rows, or not finite.
  bool factorise(const Eigen::SparseMatrix<double>& full, int nv);
  // False: not solvable, or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);

 private:
  void find_null_part(const Eigen::Ref<const Vec>& y);
  void judge_rows(int nc);
  void minimise_norm(int nc);
  // With right_; fills solution_ and residual_, whose norm is returned.
  double solve_and_refine();
  double solve_without_soft_rows(int nc);

  Eigen::SparseMatrix<double> full_, regular_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
  int nv_ = 0;
  double eps_ = 0;  // in the corner
  bool failed_ = false;
  bool redundant_ = false;  // some of few rows are redundant
  bool soft_ = false;       // some rows are nearly dependent
  int solves_ = 0;          // number of solutions summed in solution_
  Vec right_, solution_, residual_, correction_;
  Vec null_part_;  // of the multipliers, and minus its effect on x
};

}  // namespace trammel::numerics
