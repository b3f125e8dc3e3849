#include "linear/sparse_mass_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/eps.hpp"
#include "linear/dense/refinement.hpp"

namespace trammel::numerics {

namespace {

// The complement serves as it is down to this sine of a row's angle to others: its square above round-off by 1e10.
constexpr double safe_sine = 1e-3;
// And down to this eigenvalue of the whole, S's diagonal scaled to 1: round-off of its rows, 1e-13, over the root is
// 2e-9 of accelerations.
constexpr double soft_chain = 2e-9;
// Forces on a few bodies, or masses of many sizes, leave other round-off, which tells less of the softest direction.
// Below this, accelerations that the second correction still changes by more than this part of them are not trusted: of
// 594 loads on masts and 48 beams of graded masses it was 100 times their error at least.
constexpr double may_be_soft = 1e-6, trusted_change = 1e-7;
// Redundant rows whose right sides part by more than this, beside the accelerations, contradict each other: no x
// reaches them, and the nearest c that one does stands for them, as in all other solvers. Drift within a run's
// tolerance leaves less, and fronts then take the rows that they have not found dependent, which differs by no more.
// Corrections of rows alone (b = 0) are repeated until only round-off is left, all of which contradicts itself.
constexpr double contradiction = 1e-6;
// Of rows as springs, where fronts contradict each other. Less leaves more rounding of the elimination, more leaves
// more directions free, which follow the rounding of rows and forces. Accelerations of a hoop of 10,000 bays from 30 to
// 88 degrees are exact to 7e-10 by 1e-9, 1.3e-10 by 1e-10, 4e-11 by 1e-11, 4e-10 by 1e-12.
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

// Constant rows of pins in natural coordinates: of a mast or hoop half of all rows.
bool SparseMassKkt::rows_merge_unknowns(const std::vector<BodyBlock>& bodies, int nc) {
  if (places_.are_of(bodies, nc)) return merging_;
  constexpr int enough = 4;  // of so many rows one
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
  // Either a mass is not positive definite, which springs find, too, or what contradicting rows leave of the masses is
  // not.
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
      minimise_norm(bodies, reachable);  // perpendicular to the null space of G^T: in the range of G
      holds = fronts_.solve(bodies, b, reachable, x, y);
    }
    if (holds && !springs_are_better(bodies, b, c, x)) return;
    fronts_failed_ = true;
    if (!holds) factorise_springs(bodies);  // the masses were positive definite before
  }
  fronts_.solve_springs(bodies, eps_, b, c, x, y);
}

// Where accelerations miss dependent rows by more than round-off of those rows alone, round-off from far around a ring
// is between them (hoops of 400 bays: 1e-13, of 1000 1e-11 to 1e-9; masts of any length 3e-16), and moves x some
// thousand times as much. If springs differ by no more than that, it is what the fronts have lost; by more, as of long
// masts, it is what springs leave free. Rows that miss more contradict each other by drift. Found out once for these
// rows.
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
  // Multipliers along a chain add up to accelerations a million times those that are left. Their round-off does not
  // fall by corrections, but the first one takes away what is smooth of it, to which a soft mechanism yields: 1e-9 of a
  // mast's accelerations.
  double round_off() { return of_forces = 4 * eps * kkt.complement_.largest_share(y); }
  double correction() {
    const bool last = left <= round_off();
    kkt.complement_.solve(kkt.residual_, kkt.dy_);
    return last ? 0 : 1;
  }
  void apply() {
    y += kkt.dy_;
    const bool tells = ++corrections == 2;
    if (tells) kkt.x_before_.swap(x);
    x = b;
    add_rows_force(bodies, -1, y, x);
    kkt.masses_.solve(x);
    if (tells) soft = kkt.is_soft(kkt.complement_.softness(kkt.residual_, kkt.dy_), x);
  }
};

// False: the mechanism is too soft for it, which may leave no trace in any single pivot. The second correction tells:
// it answers to what the first has left, round-off, which S^-1 enlarges most in the softest direction. Of chains and
// masts of 1000 to 80,000 rows under their own weight and springs that is within 5 % of their least eigenvalue. Or the
// factors are of other rows, too far off for corrections to come closer.
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

// Springs have found theirs already: the method of multipliers takes steps in the range of the rows.
void SparseMassKkt::minimise_norm(const std::vector<BodyBlock>& bodies, Vec& y) {
  if (!redundant_ || route_ != Route::fronts) return;
  if (!least_known_) least_.factorise(bodies, nc_, rank_tolerance_);
  least_known_ = true;
  least_.minimise(y);
}

}  // namespace trammel::numerics
