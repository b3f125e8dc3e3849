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
// front_layout.hpp has which fronts there are, row_elimination.hpp a front's rows, frontal_solve.cpp the solutions. The rank is
// decided in each front, among rows of nearby units, where independent rows of a long chain differ clearly: singular values of the
// whole, which fall with n^-2 or n^-3, decide nothing. Only what goes on from front to front is rounded.
// y: of dependent rows the combinations found get 0; it is a solution, not the one of minimum norm.
//
// Where round-off has come between rows that depend on each other, on a long way around, rows are springs (frontal_springs.cpp):
//
//     (M + k G^T G) dx = r_b + k G^T r_c,   dy = k (G dx - r_c)        r: what is left of b and c
//
// repeated, which is the method of multipliers. Its steps lie in the range of the rows, contradictions are balanced in least
// squares, and what rows tell by less than 1/sqrt(k) of M comes slowly or not at all. y is of minimum norm, but for b = 0.
#pragma once

#include <functional>
#include <vector>

#include "numerics/body_block.hpp"
#include "numerics/front_layout.hpp"
#include "numerics/row_elimination.hpp"

namespace trammel::numerics {

class FrontalKkt {
 public:
  // Of the first nc rows; `identity`: in place of M. False: a mass is not positive definite. `rank_tolerance` as in kkt.hpp.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies, int nc, bool identity, double rank_tolerance);
  // Refined with the residuals of the equations until x does not change any more. False: it does not come to that. Then rows that
  // depend on others were taken for independent ones: round-off has come between them on a long way around.
  [[nodiscard]] bool solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  // The same with rows as springs: eps = 1/k, or 0 if a mass is not positive definite; and the solution with it. `softness` is
  // eps in the unit of the least mass's inverse.
  [[nodiscard]] double factorise_springs(const std::vector<BodyBlock>& bodies, int nc, bool identity, double softness);
  void solve_springs(const std::vector<BodyBlock>& bodies, double eps, const Vec& b, const Vec& c, Vec& x, Vec& y);
  int dependent() const { return dependent_; }  // rows
  // Was factorised before, in these rows' places.
  bool know(const std::vector<BodyBlock>& bodies, int nc) const { return layout_.know(bodies, nc); }

 private:
  // Where a front's numbers are in store_, and what its rows came to.
  struct Place {
    std::size_t C = 0, reflections = 0, masses = 0, K = 0, up = 0, vectors = 0;
    std::size_t pieces = 0;  // in pieces_
    int first_reflection = 0;
    int all_rows = 0, told = 0, passed = 0;
  };
  // A front by the names above: m rows, n unknowns, r told by rows and `rest` not, of those `free` and the nb of the boundary.
  struct Parts {
    int m, n, r, rest, free, nb, passed;
    const int *unknowns, *columns;  // columns: of the unknowns, those that rows tell first
    double* C;                      // by rows: R, S, and the reflections' rests
    double *K11, *W, *LV;           // W by rows; LV: L above V^T, by columns
    double *K, *up;                 // for the parent: K''; rows, each scaled by
    double* passed_scale;
    double *t, *z, *u, *passed_right;  // of a right side
    double& R(int i, int j) const { return C[i * n + j]; }
    double* S(int i) const { return C + i * n + r; }
  };
  Parts parts(std::size_t front);
  RowElimination rows_of(const Place& at, int n);

  void lay_out(const std::vector<BodyBlock>& bodies, int nc);
  // eliminate(front) after its rows are summed; false ends it.
  bool eliminate_fronts(const std::vector<BodyBlock>& bodies, const std::function<bool(std::size_t)>& eliminate);
  void place_store(const std::vector<BodyBlock>& bodies);
  bool sum_rows(std::size_t front, const std::vector<BodyBlock>& bodies);
  void eliminate_rows(std::size_t front, double rank_tolerance);
  void sum_masses(std::size_t front, const std::vector<BodyBlock>& bodies);
  bool reduce_masses(std::size_t front);
  double least_mass(const std::vector<BodyBlock>& bodies);
  void keep_rows(std::size_t front);
  void add_springs(std::size_t front, double k);
  void merge(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c);
  void expand(const std::vector<BodyBlock>& bodies, const Vec& b, Vec& x, Vec& y);
  void subtract_mass(const std::vector<BodyBlock>& bodies, const Vec& a, Vec& from);
  bool refine(const std::vector<BodyBlock>& bodies);
  void find_residuals(const std::vector<BodyBlock>& bodies);
  void approach(const std::vector<BodyBlock>& bodies, double k);
  void push_by_rows(double k);
  void remove_null_part(double k, Vec& Y);
  void subtract_masses_times(const std::vector<BodyBlock>& bodies, const Vec& X, Vec& from);
  void subtract_rows_times(const Vec& X, Vec& from);
  void subtract_rows_force(const Vec& Y, Vec& from);
  void solve_once(Vec& X, Vec& Y);
  void forward(std::size_t front);
  void backward(std::size_t front, Vec& X, Vec& Y);

  bool identity_ = false;
  int dependent_ = 0;
  FrontLayout layout_;
  std::vector<Place> places_;
  Vec store_;                 // aligned as Eigen's own: sums over pieces of it round alike in every run
  std::vector<int> columns_;  // of each front's unknowns
  std::vector<RowElimination::Reflection> reflections_;
  std::vector<double> scale_;   // of own rows
  std::vector<double> pieces_;  // what bodies give to own rows, in the order of their sources
  std::vector<int> place_of_;   // of each of a front's unknowns in its columns
  Mat K_;
  // Of merged unknowns and own rows at length one: right sides, what is left of them, solution, its corrections.
  Vec B_, C_, b_, c_, X_, Y_, dX_, dY_;
  Vec w_, scratch_, offset_, left_, left_rows_;
};

}  // namespace trammel::numerics
