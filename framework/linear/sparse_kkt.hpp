// The saddle-point systems of kkt.hpp for many bodies, by sparse direct factorisations:
//
//     [S W^T] [x]   [b]
//     [G  0 ] [y] = [c]
//
//  - Mass: S = M, one dense block a body, and W = G, by the Schur complement G M^-1 G^T (row_complement.hpp).
//  - Iteration: S any sparse matrix, W any. Sparse LU with partial pivoting of the whole.
//
// Redundant rows: the factorised matrix is the complement plus eps I (Iteration: -eps I in the corner), and residuals
// of the unchanged equations are corrected with it. This is a proximal point iteration: its steps lie in the range of
// the rows, so
// y comes out as the one of minimum norm, and directions of the rows with sigma^2 < eps count as redundant. x is
// unique.
//
// Soft rows, few and independent of the others by no more than about the square root of eps: a truss on its way through
// a singular position. Their round-off, over that little, would move x by more than it is worth, differently each time,
// so that Newton's iteration finds no
// end. They are taken for redundant too: x does not satisfy them, and y does not act along them.
//
// Long chains have such directions that are not redundant: their softest sigma falls with n^-2 (masts) or n^-3 (hoops),
// and its square is lost. From `long_chain` rows on, where the complement's pivots tell of redundant rows or a
// solution's second correction of such
// directions, the rows are eliminated front by front (frontal_kkt.hpp), refined once or twice with the residuals of the
// equations. Then y is a solution of few entries on redundant rows, not the one of minimum norm.
// Where round-off comes between redundant rows on the way around a large ring (a hoop of 400 bays and more), fronts
// contradict each other: their solution misses dependent rows by more than these rows' own round-off, or does not
// settle at all. That is measured, and
// springs take the rows' place in them. Of such a hoop they leave free what its rows tell by less than their round-off.
#pragma once

#include <vector>

#include <Eigen/SparseLU>

#include "linear/bodies/body_block.hpp"
#include "linear/bodies/body_masses.hpp"
#include "linear/complement/row_complement.hpp"
#include "linear/fronts/frontal_kkt.hpp"

namespace trammel::numerics {

class SparseMassKkt {
 public:
  static constexpr int long_chain = 1000;
  enum class Metric { mass, mass_of_before, identity };  // what stands for M; of_before: its factors are kept
  // Of the first nc rows. False: a body's mass is not positive definite. `rank_tolerance` as in kkt.hpp.
  bool factorise(const std::vector<BodyBlock>& bodies, int nc, Metric metric, double rank_tolerance = 1e-7);
  // The bodies are those of `factorise`, or have moved on a little: of long chains, fronts of theirs take over where
  // that is too far.
  // False: x or y is not finite.
  bool solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  bool redundant() const { return redundant_; }

 private:
  bool factorise_masses(const std::vector<BodyBlock>& bodies, Metric metric);
  bool leave_to_fronts(const std::vector<BodyBlock>& bodies);
  bool is_soft(double softness, const Vec& x) const;
  void find_null_part(const Vec& r);
  void remove_null_part(Vec& r);
  void minimise_norm(Vec& y);
  bool factorise_fronts(const std::vector<BodyBlock>& bodies);
  bool factorise_springs(const std::vector<BodyBlock>& bodies);
  bool springs_are_better(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, const Vec& x);
  void solve_by_fronts(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  bool solve_by_complement(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  void regularise(const std::vector<BodyBlock>& bodies);

  int nc_ = 0;
  double eps_ = 0;  // while redundant: in the corner of the matrix, or that of springs
  double rank_tolerance_ = 0;
  bool redundant_ = false;
  bool by_fronts_ = false, fronts_failed_ = false, springs_judged_ = false, identity_ = false;
  BodyMasses masses_;
  RowComplement complement_;
  FrontalKkt fronts_;
  Vec residual_, dy_, null_part_, left_, x_before_;
};

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
  Vec right_, solution_, residual_;
  Vec null_part_;  // of multipliers, and less what they do to x
};

}  // namespace trammel::numerics
