// S = G M^-1 G^T + eps 1 of many bodies, the Schur complement of the rows, and its factors L D L^T.
//
// A sum over bodies, each giving a block on the rows that touch it. Sparse; ordered once for a pattern (approximate minimum degree)
// and filled in that order, so that no factorisation has to permute it.
#pragma once

#include <vector>

#include <Eigen/SparseCholesky>

#include <trammel/types.hpp>

#include "numerics/body_block.hpp"
#include "numerics/recorded_matrix.hpp"

namespace trammel::numerics {

class RowComplement {
 public:
  // Of the first nc rows. Y[k] = G C^-T, by rows of body k's G and padded ones (packs.hpp) of zeros, with M = C C^T its mass.
  void factorise(const std::vector<BodyBlock>& bodies, const std::vector<Mat>& Y, int nc, double eps);
  // Each pivot is more than the square of `least_sine` beside its diagonal: its row's angle to those eliminated before.
  bool is_safe(double least_sine) const;
  double largest() const { return diagonal_.maxCoeff(); }
  void solve(const Vec& r, Vec& y);  // y = S^-1 r, not in place

 private:
  void assemble(const std::vector<BodyBlock>& bodies, const std::vector<Mat>& Y, double eps, RecordedMatrix& S);
  void reorder();

  RecordedMatrix S_;        // upper triangle
  std::vector<int> place_;  // of each row in the order of elimination
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper, Eigen::NaturalOrdering<int>> ldlt_;
  Vec diagonal_, ordered_;
  Mat share_;  // of a body
};

}  // namespace trammel::numerics
