// The saddle-point systems of constrained dynamics with dense rows:
//
//     [S W^T] [x]   [b]
//     [G  0 ] [y] = [c]        S: nv x nv, G and W: nc x nv
//
// Two factorisations, by the kind of S:
//  - Mass: S = M symmetric positive definite. Cholesky of M and of the Schur complement G M^-1 G^T, whose pivots warn
//    of redundant rows. Redundant rows are solved by orthogonal decompositions of G L^-T: x stays unique, and the
//    condition number is not squared. With W other than G (sliding friction) the complement G M^-1 W^T is factorised by
//    LU, or orthogonally if it is redundant or singular. M may be sparse.
//  - Iteration: S any dense matrix (sparse: frontal_iteration_kkt.hpp). LU of the whole with row pivoting. If it is
//    singular beyond redundant rows, the minimum-norm solution.
// Redundant rows are replaced by the combinations U^T G, where U is an orthonormal basis of their range: y = U z is of
// minimum norm, and the part of c outside the range, which no x reaches, is ignored. Storage is kept from one
// factorisation to the next: no allocation at constant sizes while rows are independent.
#pragma once

#include <functional>
#include <variant>

#include <trammel/decompositions.hpp>
#include <trammel/types.hpp>

#include "linear/dense/block_signs.hpp"
#include "linear/dense/cholesky.hpp"
#include "linear/dense/lu.hpp"
#include "linear/sparse/sparse_cholesky.hpp"

namespace trammel::numerics {

// The sine of the angle to the other rows below which a row counts as dependent on them, if rows are violated by
// `violation` (max norm of g, for lengths of order one). Redundant rows are exactly dependent only where they are
// satisfied: elsewhere they differ by the violation, and must not count as new rows. The tolerance is ten times the
// violation and not more, because the rows of a long chain are dependent up to n^-2. (Where branches of motion cross,
// rows differ by the distance from the crossing, over which a violation itself shifts the state; RungeKutta::Rows with
// slopes on the rows pass such points.)
double rank_tolerance_at(double violation);
// Levers [m] of the columns, 1 for coordinates that are no angles; null: unknown. The entry of a row for an angle is a
// lever. Long levers would make rows in metres look alike, and short ones the rows of a mechanism in micrometres;
// therefore columns of angles are divided by their levers. Called only where rows may be dependent.
using Levers = std::function<const Vec&()>;
// Rank of the rows scaled to length one: masses and units must not make independent rows look alike.
Eigen::Index rank_of_rows(const Mat& G, double tolerance, const Levers& levers = {});

class MassKkt {
 public:
  void measure_by(Levers levers) { levers_ = std::move(levers); }
  // False: M is not positive definite. `G` may have no rows.
  bool factorise(const Mat& M, const Mat& G, const Mat& W, double rank_tolerance = rank_tolerance_at(0));
  bool factorise(const Mat& M, const Mat& G) { return factorise(M, G, G); }
  bool factorise(const Eigen::SparseMatrix<double>& M, const Mat& G, const Mat& W,
                 double rank_tolerance = rank_tolerance_at(0));
  // Keeps the factors of M and takes new rows. W may be the same object as G.
  void change_rows(const Mat& G, const Mat& W, double rank_tolerance = rank_tolerance_at(0));
  void change_rows(const Mat& G) { change_rows(G, G); }
  // False: x or y is not finite.
  bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);
  bool redundant() const { return redundant_; }
  // Of the determinant of G M^-1 W^T; unknown with W = G, and of blocks that are nearly singular.
  void find_signs(BlockSigns& signs) const;

 private:
  void solve_with_rows(const Vec& c, Vec& x, Vec& y);
  void hold_rows(const Vec& c, Vec& z, Vec& y);
  void hold_merged_rows(const Vec& c, Vec& z, Vec& y);
  void complement(const Mat& G, const Mat& W, double rank_tolerance);
  void solve_merged(Vec& y) const;
  bool merge_coupled_rows(const Mat& G, double rank_tolerance);
  void merge_rows(const Mat& G, double rank_tolerance);
  Mat range_of(const Mat& G, double tolerance) const;

  template <class Factors, class Masses>
  bool factorise_by(const Masses& M, const Mat& G, const Mat& W, double rank_tolerance);
  template <class Solve>
  void with_mass(Solve&& solve) {
    std::visit(solve, mass_);
  }

  std::variant<Cholesky, SparseCholesky> mass_;
  Mat B_;      // G L^-T (nc x nv)
  Mat C_;      // W L^-T, where W is not G
  Mat schur_;  // B B^T or B C^T
  // U, nc x rank, if rows are redundant, where the rank may be 0; if they are singular by friction, scales of rows
  Mat merged_;
  Lu schur_lu_;
  Cholesky schur_cholesky_;
  Eigen::CompleteOrthogonalDecomposition<Mat> cod_;
  double least_pivot_ = 0;  // relative to the columns of schur_; a smaller one is round-off
  Vec w_;
  Levers levers_;
  bool redundant_ = false, coupled_ = false;
};

class IterationKkt {
 public:
  void measure_by(Levers levers) { levers_ = std::move(levers); }
  // The caller fills S() (nv x nv, zero on entry) after `begin` and then calls `factorise`.
  Mat& begin(Eigen::Index nv, Eigen::Index nc);
  // False: not finite.
  bool factorise(const Mat& W, const Mat& G, double rank_tolerance = rank_tolerance_at(0));
  // False: not solvable (singular beyond redundant rows), or not finite.
  [[nodiscard]] bool solve(const Vec& b, const Vec& c, Vec& x, Vec& y);
  bool redundant() const { return redundant_; }

 private:
  bool merge_rows(const Mat& W, const Mat& G, double rank_tolerance);
  Mat range_of(const Mat& G, double tolerance) const;

  Mat full_;
  Mat merged_;  // U, nc x rank, if rows are redundant
  Lu lu_;
  Eigen::CompleteOrthogonalDecomposition<Mat> cod_;
  Vec right_, solution_;
  Levers levers_;
  Eigen::Index nv_ = 0;
  bool redundant_ = false, singular_ = false, finite_ = true;
};

}  // namespace trammel::numerics
