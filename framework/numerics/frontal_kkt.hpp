// The saddle-point system of many bodies by elimination of its rows, which are not squared against round-off and may be redundant:
//
//     [M G^T] [x]   [b]        x: least (x - M^-1 b) in the norm of M, of those that keep the rows
//     [G  0 ] [y] = [c]
//
// Rows between equal coordinates merge unknowns (merged_unknowns.hpp); the others and the masses are summed up front by front
// (elimination_tree.hpp). In a front, F the unknowns it eliminates and B its boundary, C the rows and K the masses known there:
//
//     Q^T [C_F C_B] = [R  *   *]      Householder with column pivoting, rows at length one: r rows tell r unknowns of F,
//                     [0  0  C'']     the rest tell something of B alone and go to the parent, or nothing: they depend on others
//     x_1 = t - S (x_2, x_B)          the r unknowns, by R;  K' = K restricted to that
//     K'' = K'_BB - K'_B2 K'_22^-1 K'_2B      the free unknowns x_2, by Cholesky;  to the parent
//
// The rank is decided in each front, among rows of nearby units, where independent rows of a long chain differ clearly: singular
// values of the whole, which fall with n^-2 or n^-3, decide nothing. Only what goes on from front to front is rounded.
// y: of dependent rows the combinations found get 0; it is a solution, not the one of minimum norm.
#pragma once

#include <vector>

#include "numerics/body_block.hpp"
#include "numerics/elimination_tree.hpp"
#include "numerics/merged_unknowns.hpp"

namespace trammel::numerics {

class FrontalKkt {
 public:
  // Of the first nc rows; `identity`: in place of M. False: a mass is not positive definite. `rank_tolerance` as in kkt.hpp.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies, int nc, bool identity, double rank_tolerance);
  void solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  int dependent() const { return dependent_; }                    // rows
  bool know(const std::vector<BodyBlock>& bodies, int nc) const;  // was factorised before, in these rows' places

 private:
  // A column of a body's Gt, which is part of a row of the front; or, of row -1, a body's mass. From maps_[map] on, the front's column
  // for each of the body's velocities, -1: none.
  struct Source {
    int body, column, row, map;
  };
  struct Child {
    int front, map;  // from maps_[map] on, the parent's column for each of its boundary
  };
  // 1 - tau v v^T on rows begin ... end - 1
  struct Reflection {
    int begin = 0, end = 0;
    double tau = 0;
    std::size_t v = 0;  // in store_
  };
  struct Range {
    int begin = 0, end = 0;
  };
  struct Front {
    int eliminated = 0, unknowns = 0;                                   // the rest is the boundary
    int first_unknown = 0, first_row = 0;                               // in unknowns_, own_rows_
    int own_rows = 0, most_rows = 0;                                    // most: with those of all children
    Range rows, masses, children;                                       // in sources_, children_
    std::size_t C = 0, H = 0, reduced = 0, K = 0, up = 0, vectors = 0;  // in store_
    int first_reflection = 0;                                           // in reflections_
    int all_rows = 0, told = 0, passed = 0, reflections = 0;
    int most_reflections() const { return unknowns; }
    int free() const { return eliminated - told; }
    int rest() const { return unknowns - told; }
    int boundary() const { return unknowns - eliminated; }
  };

  void analyse(const std::vector<BodyBlock>& bodies, int nv);
  std::vector<int> find_points(const std::vector<BodyBlock>& bodies, int nv, std::vector<int>& weight) const;
  void find_rows(const std::vector<BodyBlock>& bodies, const std::vector<int>& point);
  void lay_out(const std::vector<BodyBlock>& bodies, const std::vector<int>& point);
  void place_store();
  bool sum_rows(Front& front, const std::vector<BodyBlock>& bodies);
  void sum_masses(const Front& front, const std::vector<BodyBlock>& bodies);
  class RowElimination;
  void eliminate_rows(Front& front, double rank_tolerance);
  void reflect_all(const Front& front, bool backwards, Vec& w) const;
  bool reduce_masses(const Front& front);
  void forward(const Front& front, const Vec& c);
  void backward(const Front& front, Vec& y);

  bool identity_ = false;
  int nc_ = -1, dependent_ = 0;
  std::vector<int> rows_of_bodies_;
  MergedUnknowns merged_;
  std::vector<std::vector<int>> points_of_row_;  // where it was ever found not to vanish
  EliminationTree tree_;
  std::vector<Front> fronts_;
  std::vector<int> unknowns_, own_rows_, maps_;
  std::vector<Source> sources_;
  std::vector<Child> children_;
  std::vector<double> store_;
  std::vector<int> columns_;  // of each front: its unknowns, those that rows tell first
  std::vector<Reflection> reflections_;
  std::vector<double> scale_;  // of own rows
  std::vector<double> norms_;
  Mat K_, S_, T_;
  Vec w_, b_, c_, X_, offset_, left_;
};

}  // namespace trammel::numerics
