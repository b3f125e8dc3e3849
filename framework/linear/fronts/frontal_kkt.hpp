// The saddle-point system of many bodies by elimination of its rows, which may be redundant; the rows are not squared.
//
//     [M G^T] [x]   [b]        x minimises |x - M^-1 b| in the norm of M among all x that satisfy the rows
//     [G  0 ] [y] = [c]
//
// Rows between equal coordinates merge unknowns (merged_unknowns.hpp); the other rows and the masses are summed front
// by front (elimination_tree.hpp). In a front, F are the unknowns that it eliminates and B its boundary, C the rows and
// K the masses assembled there:
//
//     Q^T [C_F C_B] = [R  *   *]      Householder with column pivoting, rows at length one: r rows are pivots in F,
//                     [0  0  C'']     the other rows concern B only and go to the parent, or are dependent
//     x_1 = P c - S (x_2, x_B)        the r unknowns, by R: P = R^-1 Q_1^T;  K' = K restricted to these motions
//     K'' = K'_BB - K'_B2 K'_22^-1 K'_2B      the free unknowns x_2, by Cholesky;  to the parent
//
// front_layout.hpp has the fronts, row_elimination.hpp the rows of a front, frontal_solve.cpp the solutions. The rank
// is decided in each front, among rows of neighbouring units, where independent rows of a long chain differ clearly.
// Singular values of the whole matrix fall with n^-2 or n^-3 and decide nothing. Only what passes from front to front
// is rounded. Multipliers: the dependent combinations found get 0, so y is a solution, but not the one of minimum norm.
//
// If round-off has come between rows that depend on each other over a long way around a ring, the rows are replaced by
// stiff springs (frontal_springs.cpp):
//
//     (M + k G^T G) dx = r_b + k G^T r_c,   dy = k (G dx - r_c)        r: residuals of both equations
//
// which is repeated (the method of multipliers). Its steps lie in the range of the rows, contradictions are balanced in
// least squares, and components that rows see by less than 1/sqrt(k) of M converge slowly or not at all. y is of
// minimum norm, except for b = 0.
#pragma once

#include <vector>

#include "linear/bodies/body_block.hpp"
#include "linear/fronts/front_contributions.hpp"
#include "linear/fronts/front_layout.hpp"

namespace trammel::numerics {

class FrontalKkt {
 public:
  // For the first nc rows; `identity` replaces M. False: a mass is not positive definite. `rank_tolerance` as in
  // kkt.hpp.
  [[nodiscard]] bool factorise(const std::vector<BodyBlock>& bodies, int nc, bool identity, double rank_tolerance);
  // Refined with the residuals of the equations until x does not change any more. False: this does not converge,
  // because rows that depend on others were taken for independent ones: round-off has come between them over a long way
  // around.
  [[nodiscard]] bool solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y);
  // The same with rows as springs: returns eps = 1/k, or 0 if a mass is not positive definite; and the solution with
  // it. `softness` is eps in the unit of the least mass's inverse.
  [[nodiscard]] double factorise_springs(const std::vector<BodyBlock>& bodies, int nc, bool identity, double softness);
  void solve_springs(const std::vector<BodyBlock>& bodies, double eps, const Vec& b, const Vec& c, Vec& x, Vec& y);
  int dependent() const { return dependent_; }  // number of dependent rows
  bool redundant() const { return dependent_ > 0; }
  // The residual of the last solution in dependent rows of length one, relative to x; 0 if it is round-off of a row's
  // own products.
  double missed() const { return missed_; }
  // True if it was factorised before for these rows and bodies.
  bool is_built_for(const std::vector<BodyBlock>& bodies, int nc) const { return layout_.is_built_for(bodies, nc); }

 private:
  // Where the data of a front are, and the ranks of its rows.
  struct Place {
    std::size_t factors = 0;  // offset in store_, front after front
    std::size_t K = 0;        // offset in passed_on_; free again after the parent has added it
    int all_rows = 0, pivots = 0, passed = 0;
  };
  // A front by the names above: m rows, n unknowns, r pivots by rows and `rest` other unknowns, of which `free` are
  // eliminated here and nb are the boundary.
  struct Parts {
    int m, n, r, rest, free, nb, passed;
    const int *unknowns, *columns;     // columns: permutation of the unknowns, pivots of the rows first
    double *SP, *Q;                    // by rows: S beside P; Q_2^T of the rows passed on
    double *W, *LV, *K11;              // W by rows; LV: L above V^T, by columns
    double *K, *up;                    // for the parent: K''; its rows, of length one
    double *t, *z, *u, *passed_right;  // parts of a right side
    double* S(int i) const { return SP + i * (rest + m); }
    double* P(int i) const { return SP + i * (rest + m) + rest; }
  };
  Parts parts(std::size_t front);
  Parts place_factors(std::size_t front, int pivots, int passed);
  // The data of a child for its parent, by the same names.
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
  // Non-zero entries of own rows of length one, row after row; only with springs.
  struct Entry {
    int unknown;
    double value;
  };
  std::vector<Entry> entries_;
  std::vector<std::size_t> entries_end_;
  Vec rows_, K_;  // C and K of one front
  // For merged unknowns and own rows of length one: right sides, residuals, solution, corrections.
  Vec B_, C_, b_, c_, X_, Y_, dX_, dY_;
  Vec w_, scratch_, offset_, left_, left_rows_;
};

}  // namespace trammel::numerics
