#include "linear/sparse_mass_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/eps.hpp"
#include "linear/dense/refinement.hpp"

namespace trammel::numerics {

namespace {

// The complement is used down to this sine of a row's angle to others: its square exceeds round-off by 1e10.
constexpr double safe_sine = 1e-3;
// And down to this smallest eigenvalue of S with its diagonal scaled to 1: the round-off of its rows, 1e-13, divided by
// the root is 2e-9 of the accelerations.
constexpr double soft_chain = 2e-9;
// Forces on a few bodies, or masses of very different sizes, leave other round-off, which shows less of the softest
// direction. Below this eigenvalue, accelerations that the second correction still changes by more than
// `trusted_change` are not trusted. (In 594 loads on masts and 48 beams of graded masses that change was at least 100
// times the error.)
constexpr double may_be_soft = 1e-6, trusted_change = 1e-7;
// Redundant rows whose right sides differ by more than this, relative to the accelerations, contradict each other: no x
// reaches them, and the nearest reachable c replaces them, as in all other solvers. Drift within a run's tolerance is
// smaller; fronts then use the rows that they have not found dependent, which differ by no more. Corrections of rows
// alone (b = 0) are repeated until only round-off is left, which always contradicts itself.
constexpr double contradiction = 1e-6;
// eps of rows as springs, where fronts contradict each other. A smaller value leaves more rounding of the elimination;
// a larger one leaves more directions free, which then follow the rounding of rows and forces. Errors of the
// accelerations of a hoop of 10,000 bays from 30 to 88 degrees: 7e-10 with eps = 1e-9, 1.3e-10 with 1e-10, 4e-11 with
// 1e-11, 4e-10 with 1e-12.
constexpr double of_springs = 1e-10;

}  // namespace

bool SparseMassKkt::factorise(const std::vector<BodyBlock>& bodies, int nc, Metric metric, double rank_tolerance) {
  nc_ = nc;
  redundant_ = least_known_ = false;
  rank_tolerance_ = rank_tolerance;
  if (metric != Metric::mass_of_before) identity_ = metric == Metric::identity;
  if (rows_merge_unknowns(bodies, nc)) return factorise_fronts(bodies);
  if (!factorise_masses(bodies, metric)) return false;
  route_ = Route::complement;
  const double least_sine = std::max(safe_sine, 10 * rank_tolerance);
  return complement_.factorise(bodies, masses_, nc, least_sine) || factorise_fronts(bodies);
}

// True if enough constant rows of pins in natural coordinates merge unknowns: half of all rows in a mast or hoop.
bool SparseMassKkt::rows_merge_unknowns(const std::vector<BodyBlock>& bodies, int nc) {
  if (places_.are_of(bodies, nc)) return merging_;
  constexpr int enough = 4;  // one row of so many must merge unknowns
  places_.take(bodies, nc);
  fronts_failed_ = springs_judged_ = false;
  return merging_ = enough * MergedUnknowns::count_constant_rows(bodies, nc) >= nc && nc > 0;
}

bool SparseMassKkt::factorise_masses(const std::vector<BodyBlock>& bodies, Metric metric) {
  if (metric == Metric::mass_of_before && masses_.are_of(bodies)) return true;
  if (!identity_) return masses_.factorise(bodies);
  masses_.take_identity(bodies);
  return true;
}

bool SparseMassKkt::factorise_fronts(const std::vector<BodyBlock>& bodies) {
  if (fronts_failed_) return factorise_springs(bodies);
  route_ = Route::fronts;
  if (fronts_.factorise(bodies, nc_, identity_, rank_tolerance_)) {
    redundant_ = fronts_.dependent() > 0;
    return true;
  }
  // Either a mass is not positive definite, which springs will find too, or contradicting rows have left masses that
  // are not.
  fronts_failed_ = true;
  return factorise_springs(bodies);
}

bool SparseMassKkt::factorise_springs(const std::vector<BodyBlock>& bodies) {
  route_ = Route::springs;
  redundant_ = true;
  eps_ = fronts_.factorise_springs(bodies, nc_, identity_, std::max(of_springs, rank_tolerance_ * rank_tolerance_));
  return eps_ > 0;
}

void SparseMassKkt::solve_by_fronts(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (route_ == Route::fronts) {
    bool holds = fronts_.solve(bodies, b, c, x, y);
    if (fronts_.missed() > contradiction && !b.isZero(0)) {
      Vec reachable = c;
      minimise_norm(bodies, reachable);  // perpendicular to the null space of G^T, so in the range of G
      holds = fronts_.solve(bodies, b, reachable, x, y);
    }
    if (holds && !springs_are_better(bodies, b, c, x)) return;
    fronts_failed_ = true;
    if (!holds) factorise_springs(bodies);  // masses were positive definite before
  }
  fronts_.solve_springs(bodies, eps_, b, c, x, y);
}

// True if springs are more exact than the fronts, for these rows. If accelerations violate dependent rows by more than
// the rows' own round-off, round-off from the way around a ring has come between the rows (hoops of 400 bays: 1e-13, of
// 1000 bays 1e-11 to 1e-9; masts of any length 3e-16) and changes x by some thousand times as much. If the solution by
// springs differs by no more than that, the fronts have lost these digits; if it differs by more, as in long masts,
// springs leave directions free. Rows with larger violations contradict each other by drift.
bool SparseMassKkt::springs_are_better(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, const Vec& x) {
  constexpr double round_off = 1e-13, drift = 5e-8, moves = 1e4;
  const double missed = fronts_.missed();
  if (springs_judged_ || b.isZero(0) || !(missed > round_off && missed < drift)) return false;
  springs_judged_ = true;
  if (!factorise_springs(bodies)) return false;
  Vec by_springs, y;
  fronts_.solve_springs(bodies, eps_, b, c, by_springs, y);
  if ((by_springs - x).lpNorm<Eigen::Infinity>() <= moves * missed * x.lpNorm<Eigen::Infinity>()) return true;
  route_ = Route::fronts;
  return !fronts_.factorise(bodies, nc_, identity_, rank_tolerance_) && factorise_springs(bodies);
}

bool SparseMassKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  const bool by_complement = route_ == Route::complement && solve_by_complement(bodies, b, c, x, y);
  if (!by_complement) {
    if (route_ == Route::complement && !factorise_fronts(bodies)) {
      x.setConstant(std::numeric_limits<double>::quiet_NaN());  // for callers that look at x alone
      return false;
    }
    solve_by_fronts(bodies, b, c, x, y);
  }
  return x.allFinite() && y.allFinite();
}

struct SparseMassKkt::ByComplement {
  SparseMassKkt& kkt;
  const std::vector<BodyBlock>& bodies;
  const Vec &b, &c;
  Vec &x, &y;
  int corrections = 0;
  bool soft = false;
  double left = 0, of_forces = 0;

  double residual() {
    kkt.residual_ = -c;
    add_rows_times(bodies, 1, x, kkt.residual_);
    return left = kkt.residual_.lpNorm<Eigen::Infinity>();
  }
  // Along a chain, multipliers add up to accelerations a million times larger than the result. Corrections do not
  // reduce their round-off, but the first one removes its smooth part, which affects a soft mechanism: 1e-9 of the
  // accelerations of a mast.
  double round_off() { return of_forces = 4 * eps * kkt.complement_.largest_share(y); }
  double correction() {
    const bool last = left <= round_off();
    kkt.complement_.solve(kkt.residual_, kkt.dy_);
    return last ? 0 : 1;
  }
  void apply() {
    y += kkt.dy_;
    const bool judges = ++corrections == 2;
    if (judges) kkt.x_before_.swap(x);
    x = b;
    add_rows_force(bodies, -1, y, x);
    kkt.masses_.solve(x);
    if (judges) soft = kkt.is_soft(kkt.complement_.softness(kkt.residual_, kkt.dy_), x);
  }
};

// False: the mechanism is too soft for the complement, which no single pivot has to show, or the factors belong to rows
// so different that corrections do not converge. The second correction shows softness: its right side is round-off,
// which S^-1 amplifies most in the softest direction. For chains and masts of 1000 to 80,000 rows under their own
// weight and springs the estimate is within 5 % of the smallest eigenvalue.
bool SparseMassKkt::solve_by_complement(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x,
                                        Vec& y) {
  y.setZero(nc_);
  x = b;
  masses_.solve(x);
  if (nc_ == 0) return true;
  ByComplement equations{*this, bodies, b, c, x, y};
  const double left = refine(equations, {.most = 4, .enough = 0, .falls = 0.9}).residual;
  const bool astray =
      left > 1e3 * equations.of_forces && left > 1e3 * (equations.round_off() + 4 * eps * x.lpNorm<Eigen::Infinity>());
  return !equations.soft && !astray;
}

bool SparseMassKkt::is_soft(double softness, const Vec& x) const {
  if (softness >= may_be_soft) return false;
  const double change = (x - x_before_).lpNorm<Eigen::Infinity>();
  return softness < soft_chain || change > trusted_change * x.lpNorm<Eigen::Infinity>();
}

// Springs have found these already: the method of multipliers takes steps in the range of the rows.
void SparseMassKkt::minimise_norm(const std::vector<BodyBlock>& bodies, Vec& y) {
  if (!redundant_ || route_ != Route::fronts) return;
  if (!least_known_) least_.factorise(bodies, nc_, rank_tolerance_);
  least_known_ = true;
  least_.minimise(y);
}

}  // namespace trammel::numerics
