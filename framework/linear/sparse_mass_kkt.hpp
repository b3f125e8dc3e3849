// The saddle-point system of many bodies, S = M in one dense block a body and W = G,
//
//     [M G^T] [x]   [b]
//     [G  0 ] [y] = [c]
//
// by one of two routes, chosen by the rows at each factorisation:
//  - Schur complement G M^-1 G^T (complement/row_complement.hpp): rows that do not merge unknowns and are independent
//    by more than the round-off of their squares, as of rigid bodies in chains and trees;
//  - fronts (fronts/frontal_kkt.hpp): all others. Constant rows that merge unknowns leave small fronts (trusses), and
//    redundant or nearly dependent rows are not squared there.
//
// Long chains have soft directions: their smallest singular value falls with n^-2 (masts) or n^-3 (hoops), and its
// square is lost in the complement although no pivot shows it. The second correction of a solution shows it, and fronts
// take over. In a large ring (a hoop of 400 bays and more) round-off comes between redundant rows on the way around,
// and fronts contradict each other: their solution violates dependent rows by more than these rows' own round-off, or
// does not converge. This is measured, and stiff springs then replace the rows. They leave free what the rows of such a
// hoop see by less than their round-off.
//
// x is unique. y of redundant rows is not, until `minimise_norm` makes it the one of minimum norm: that costs ten times
// as much as x, and many steps need x only.
#pragma once

#include <optional>
#include <vector>

#include "linear/bodies/body_block.hpp"
#include "linear/bodies/body_masses.hpp"
#include "linear/complement/row_complement.hpp"
#include "linear/fronts/frontal_kkt.hpp"
#include "linear/fronts/least_multipliers.hpp"
#include "linear/saddle_point.hpp"

namespace trammel::numerics {

class SparseMassKkt {
 public:
  enum class Metric { mass, mass_of_before, identity };  // in place of M; mass_of_before keeps the factors
  // For the first nc rows. False: a body's mass is not positive definite. `rank_tolerance` as in kkt.hpp.
  bool factorise(const std::vector<BodyBlock>& bodies, int nc, Metric metric,
                 double rank_tolerance = least_rank_tolerance);
  // The bodies are those of `factorise`, or have moved a little since. For long chains that may be too far; then fronts
  // of the present bodies take over. False: x or y is not finite.
  bool solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  // Replaces y by the one of least norm with the same G^T y.
  void minimise_norm(const std::vector<BodyBlock>& bodies, Vec& y);
  bool redundant() const { return redundant_; }

 private:
  enum class Route { complement, fronts, springs };
  struct ByComplement;  // equations for refinement.hpp
  bool rows_merge_unknowns(const std::vector<BodyBlock>& bodies, int nc);
  bool factorise_masses(const std::vector<BodyBlock>& bodies, Metric metric);
  bool factorise_fronts(const std::vector<BodyBlock>& bodies);
  bool factorise_springs(const std::vector<BodyBlock>& bodies);
  bool springs_are_better(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, const Vec& x);
  bool is_soft(double softness, const Vec& x) const;
  bool solve_by_complement(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  void solve_by_fronts(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);

  Route route_ = Route::complement;
  int nc_ = 0;
  double eps_ = 0;  // of the springs
  double rank_tolerance_ = 0;
  bool redundant_ = false, identity_ = false;
  bool fronts_failed_ = false, springs_judged_ = false;  // for these rows and bodies
  RowPlaces places_;
  bool merging_ = false;  // these rows merge unknowns
  BodyMasses masses_;
  RowComplement complement_;
  FrontalKkt fronts_;
  LeastMultipliers least_;
  bool least_known_ = false;
  Vec residual_, dy_, x_before_;
};

}  // namespace trammel::numerics
