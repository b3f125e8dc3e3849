// The saddle-point system of many bodies by elimination of its rows, which are not squared against round-off and may be
// redundant:
//
//     [M G^T] [x]   [b]        x: least (x - M^-1 b) in the norm of M, of those that keep the rows
//     [G  0 ] [y] = [c]
//
// Rows between equal coordinates merge unknowns (merged_unknowns.hpp); the others and the masses are summed up front by
// front (elimination_tree.hpp). In a front, F the unknowns it eliminates and B its boundary, C the rows and K the
// masses known there:
//
//     Q^T [C_F C_B] = [R  *   *]      Householder with column pivoting, rows at length one: r rows are pivots in F,
//                     [0  0  C'']     the rest concern B alone and go to the parent, or depend on others
//     x_1 = P c - S (x_2, x_B)        the r unknowns, by R: P = R^-1 Q_1^T;  K' = K restricted to that
//     K'' = K'_BB - K'_B2 K'_22^-1 K'_2B      the free unknowns x_2, by Cholesky;  to the parent
//
// front_layout.hpp has which fronts there are, row_elimination.hpp a front's rows, frontal_solve.cpp the solutions. The
// rank is decided in each front, among rows of nearby units, where independent rows of a long chain differ clearly:
// singular values of the whole, which fall with n^-2 or n^-3, decide nothing. Only what goes on from front to front is
// rounded. y: of dependent rows the combinations found get 0; it is a solution, not the one of minimum norm.
//
// Where round-off has come between rows that depend on each other, on a long way around, rows are springs
// (frontal_springs.cpp):
//
//     (M + k G^T G) dx = r_b + k G^T r_c,   dy = k (G dx - r_c)        r: what is left of b and c
//
// repeated, which is the method of multipliers. Its steps lie in the range of the rows, contradictions are balanced in
// least squares, and what rows tell by less than 1/sqrt(k) of M comes slowly or not at all. y is of minimum norm, but
// for b =
// 0.
#pragma once

#include <vector>

#include "linear/bodies/body_block.hpp"
#include "linear/fronts/front_contributions.hpp"
#include "linear/fronts/front_layout.hpp"

namespace trammel::numerics {

class FrontalKkt {
 public:
  // Of the first nc rows; `identity`: in place of M. False: a mass is not positive definite. `rank_tolerance` as in
  // kkt.hpp.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies, int nc, bool identity, double rank_tolerance);
  // Refined with the residuals of the equations until x does not change any more. False: it does not come to that. Then
  // rows that depend on others were taken for independent ones: round-off has come between them on a long way around.
  [[nodiscard]] bool solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  // The same with rows as springs: eps = 1/k, or 0 if a mass is not positive definite; and the solution with it.
  // `softness` is eps in the unit of the least mass's inverse.
  [[nodiscard]] double factorise_springs(const std::vector<BodyBlock>& bodies, int nc, bool identity, double softness);
  void solve_springs(const std::vector<BodyBlock>& bodies, double eps, const Vec& b, const Vec& c, Vec& x, Vec& y);
  int dependent() const { return dependent_; }  // rows
  bool redundant() const { return dependent_ > 0; }
  // By what the last solution misses rows, of length one, that depend on others, relative to x; round-off of a row's
  // own products is 0.
  double missed() const { return missed_; }
  // Was factorised before, in these rows' places.
  bool know(const std::vector<BodyBlock>& bodies, int nc) const { return layout_.know(bodies, nc); }

 private:
  // Where a front's numbers are, and what its rows came to.
  struct Place {
    std::size_t factors = 0;  // in store_, one front's behind the other's
    std::size_t K = 0;        // in passed_on_: the parent takes it, and its place is free again
    int all_rows = 0, pivots = 0, passed = 0;
  };
  // A front by the names above: m rows, n unknowns, r pivots by rows and `rest` not, of those `free` and the nb of the
  // boundary.
  struct Parts {
    int m, n, r, rest, free, nb, passed;
    const int *unknowns, *columns;     // columns: of the unknowns, those that rows tell first
    double *SP, *Q;                    // by rows: S beside P; of the rows passed on Q_2^T
    double *W, *LV, *K11;              // W by rows; LV: L above V^T, by columns
    double *K, *up;                    // for the parent: K''; rows of length one
    double *t, *z, *u, *passed_right;  // of a right side
    double* S(int i) const { return SP + i * (rest + m); }
    double* P(int i) const { return SP + i * (rest + m) + rest; }
  };
  Parts parts(std::size_t front);
  Parts place_factors(std::size_t front, int pivots, int passed);
  // What a child has for its parent, by the same names.
  struct Below {
    int nb, passed;
    const double *K, *up;
    double* passed_right;
  };
  Below passed_by(const FrontLayout::Child& child);

  void lay_out(const std::vector<BodyBlock>& bodies, int nc, bool springs);
  bool eliminate_fronts(const std::vector<BodyBlock>& bodies);
  void place_store(const std::vector<BodyBlock>& bodies);
  void place_passed_on();
  void prefetch_rows(std::size_t front, const std::vector<BodyBlock>& bodies) const;
  void prefetch_place_for_factors(std::size_t front) const;
  bool sum_rows(std::size_t front, const std::vector<BodyBlock>& bodies);
  void eliminate_rows(std::size_t front);
  void sum_masses(std::size_t front, const std::vector<BodyBlock>& bodies);
  bool reduce_masses(std::size_t front);
  double least_mass(const std::vector<BodyBlock>& bodies);
  void keep_rows(std::size_t front);
  void add_springs(std::size_t front);
  void merge(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c);
  void expand(const Vec& b, Vec& x, Vec& y);
  bool refine();
  double find_missed(double size);
  void find_residuals();
  void subtract_masses_times(const Vec& X, Vec& from) const;
  void subtract_masses_times(std::size_t front, const Vec& X, Vec& from) const;
  void approach(double k);
  void push_by_rows(double k, bool taken);
  void remove_null_part(double k, Vec& Y);
  void subtract_rows_times(const Vec& X, Vec& from);
  void subtract_rows_force(const Vec& Y, Vec& from);
  void solve_once(Vec& X, Vec& Y);
  enum class Way { up, down };
  void prefetch_factors(std::size_t front, Way way);
  void forward(std::size_t front);
  void backward(std::size_t front, Vec& X, Vec& Y);

  bool identity_ = false, springs_ = false;
  double rank_tolerance_ = 0, stiffness_ = 0;  // of springs, k
  int dependent_ = 0;
  double missed_ = 0;
  FrontLayout layout_;
  std::vector<Place> places_;
  Vec store_, passed_on_;
  std::size_t stored_ = 0;
  std::vector<int> columns_;   // of each front's unknowns
  std::vector<double> scale_;  // of own rows
  FrontContributions pieces_;
  std::vector<int> place_of_;  // of each of a front's unknowns in its columns
  // Own rows at length one without their zeros, row after row; only with springs.
  struct Entry {
    int unknown;
    double value;
  };
  std::vector<Entry> entries_;
  std::vector<std::size_t> entries_end_;
  Vec rows_, K_;  // C and K of one front
  // Of merged unknowns and own rows at length one: right sides, what is left of them, solution, its corrections.
  Vec B_, C_, b_, c_, X_, Y_, dX_, dY_;
  Vec w_, scratch_, offset_, left_, left_rows_;
};

}  // namespace trammel::numerics
