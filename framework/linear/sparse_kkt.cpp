#include "linear/sparse_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/dense/eps.hpp"

namespace trammel::numerics {

namespace {

// Of S's and G's scales. Large beside its round-off, so that corrections converge; its square root is the singular
// value, relative to the largest, below which rows count as redundant. A chain's own rows must not, whose softest falls
// with the square of their number:
// among few rows alone soft ones are those of a singular position.
constexpr int long_from = 200;
constexpr double regularisation(int nc) {
  return nc < long_from ? 1e-10 : 1e-12;
}
// Of a long chain the complement serves as it is down to this sine of a row's angle to others: its square above
// round-off by 1e10.
constexpr double safe_sine = 1e-3;
// And down to this eigenvalue of the whole, S's diagonal scaled to 1: round-off of its rows, 1e-13, over the root is
// 2e-9 of
// accelerations.
constexpr double soft_chain = 2e-9;
// Forces on a few bodies, or masses of many sizes, leave other round-off, which tells less of the softest direction.
// Below this, accelerations that the second correction still changes by more than this part of them are not trusted: of
// 594 loads on masts
// and 48 beams of graded masses it was 100 times their error at least.
constexpr double may_be_soft = 1e-6, trusted_change = 1e-7;
// Of redundant rows.
constexpr double of_redundant = 1e-10;
// Of rows as springs, where fronts contradict each other. Less leaves more rounding of the elimination, more leaves
// more directions free, which follow the rounding of rows and forces. Accelerations of a hoop of 10,000 bays from 30 to
// 88 degrees are exact to
// 7e-10 by 1e-9, 1.3e-10 by 1e-10, 4e-11 by 1e-11, 4e-10 by 1e-12.
constexpr double of_springs = 1e-10;
// Redundant rows part by no more than this where they are violated, the largest rank tolerance of kkt.hpp.
constexpr double parting = 1e-2;

// Corrects until the residual is `enough` or stops to fall: `residual(r)` fills r and returns its norm, `correct(r)`
// uses it.
// Of a residual that is no more than round_off() one correction is left to be made.
template <class Residual, class Correct, class RoundOff>
double refine(Residual&& residual, Correct&& correct, double enough, RoundOff&& round_off, int most, Vec& r) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0;; ++i) {
    const double now = residual(r);
    if (!(now > enough) || i == most || !(now < 0.9 * before)) return now;
    before = now;
    const bool last = now <= round_off();
    correct(r);
    if (last) return now;
  }
}

}  // namespace

bool SparseMassKkt::factorise(const std::vector<BodyBlock>& bodies, int nc, Metric metric, double rank_tolerance) {
  nc_ = nc;
  redundant_ = false;
  rank_tolerance_ = rank_tolerance;
  if (metric != Metric::mass_of_before) identity_ = metric == Metric::identity;
  const bool known = nc >= long_chain && fronts_.know(bodies, nc);
  by_fronts_ = known;
  fronts_failed_ = fronts_failed_ && known, springs_judged_ = springs_judged_ && known;
  if (by_fronts_) return factorise_fronts(bodies);
  if (!factorise_masses(bodies, metric)) return false;
  if (nc == 0) return true;
  complement_.factorise(bodies, masses_, nc, 0);
  if (nc >= long_chain && !complement_.is_safe(std::max(safe_sine, 10 * rank_tolerance)))
    return leave_to_fronts(bodies);
  redundant_ = !complement_.is_safe(10 * rank_tolerance);
  if (redundant_) regularise(bodies);
  return true;
}

bool SparseMassKkt::leave_to_fronts(const std::vector<BodyBlock>& bodies) {
  by_fronts_ = true;
  complement_ = {};  // a mast's takes more memory than its fronts
  return factorise_fronts(bodies);
}

// Large beside the complement's round-off, so that corrections converge and the unreachable is told from the rest.
void SparseMassKkt::regularise(const std::vector<BodyBlock>& bodies) {
  eps_ = std::max(of_redundant, rank_tolerance_ * rank_tolerance_) * complement_.largest();
  complement_.factorise(bodies, masses_, nc_, eps_);
}

bool SparseMassKkt::factorise_masses(const std::vector<BodyBlock>& bodies, Metric metric) {
  if (metric == Metric::mass_of_before && masses_.are_of(bodies)) return true;
  if (!identity_) return masses_.factorise(bodies);
  masses_.take_identity(bodies);
  return true;
}

bool SparseMassKkt::factorise_fronts(const std::vector<BodyBlock>& bodies) {
  if (fronts_failed_) return factorise_springs(bodies);
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
  redundant_ = true;
  eps_ = fronts_.factorise_springs(bodies, nc_, identity_, std::max(of_springs, rank_tolerance_ * rank_tolerance_));
  return eps_ > 0;
}

// eps (S + eps)^-1 keeps the part of r in the null space of S and shrinks the rest by eps/sigma^2; twice.
void SparseMassKkt::find_null_part(const Vec& r) {
  complement_.solve(r, dy_);
  complement_.solve(dy_, null_part_);
  null_part_ *= eps_ * eps_;
}

// Round-off asks for more than one pass. What the rows can balance loses a little, which the next correction restores.
void SparseMassKkt::remove_null_part(Vec& r) {
  for (int pass = 0; pass < 3; ++pass) {
    find_null_part(r);
    r -= null_part_;
  }
}

// y must lose nothing else: of rows of heavy bodies sigma^2 is not large beside eps. The null part of the null part is
// taken until that does not change it any more.
void SparseMassKkt::minimise_norm(Vec& y) {
  constexpr int passes = 3, most = 8;
  for (int pass = 0; pass < passes; ++pass) {
    const double nothing = eps * y.lpNorm<Eigen::Infinity>();
    left_ = y;
    for (int i = 0; i < most; ++i) {
      find_null_part(left_);
      left_ -= null_part_;
      const double lost = left_.lpNorm<Eigen::Infinity>();
      left_.swap(null_part_);
      if (lost <= nothing) break;
    }
    y -= left_;
    if (left_.lpNorm<Eigen::Infinity>() <= nothing) break;
  }
}

void SparseMassKkt::solve_by_fronts(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (!fronts_failed_) {
    const bool holds = fronts_.solve(bodies, b, c, x, y);
    if (holds && !springs_are_better(bodies, b, c, x)) return;
    fronts_failed_ = true;
    if (!holds) factorise_springs(bodies);  // the masses were positive definite before
  }
  fronts_.solve_springs(bodies, eps_, b, c, x, y);
}

// Where accelerations miss dependent rows by more than round-off of those rows alone, round-off from far around a ring
// is between them (hoops of 400 bays: 1e-13, of 1000 1e-11 to 1e-9; masts of any length 3e-16), and moves x some
// thousand times as much. If
// springs differ by no more than that, it is what the fronts have lost; by more, as of long masts, it is what springs
// leave free. Rows that miss more contradict each other by drift. Found out once for these rows.
bool SparseMassKkt::springs_are_better(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, const Vec& x) {
  constexpr double round_off = 1e-13, drift = 5e-8, moves = 1e4;
  const double missed = fronts_.missed();
  if (springs_judged_ || b.isZero(0) || !(missed > round_off && missed < drift)) return false;
  springs_judged_ = true;
  if (!factorise_springs(bodies)) return false;
  Vec by_springs, y;
  fronts_.solve_springs(bodies, eps_, b, c, by_springs, y);
  if ((by_springs - x).lpNorm<Eigen::Infinity>() <= moves * missed * x.lpNorm<Eigen::Infinity>()) return true;
  return !fronts_.factorise(bodies, nc_, identity_, rank_tolerance_) && factorise_springs(bodies);
}

bool SparseMassKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (by_fronts_ || !solve_by_complement(bodies, b, c, x, y)) {
    if (!by_fronts_ && !leave_to_fronts(bodies)) {
      x.setConstant(std::numeric_limits<double>::quiet_NaN());  // for callers that look at x alone
      return false;
    }
    solve_by_fronts(bodies, b, c, x, y);
  }
  return x.allFinite() && y.allFinite();
}

// False: a long chain is too soft for it, which may leave no trace in any single pivot. The second correction tells: it
// answers to what the first has left, round-off, which S^-1 enlarges most in the softest direction. Of chains and masts
// of 1000 to 80,000
// rows under their own weight and springs that is within 5 % of their least eigenvalue. Or the factors are of other
// rows, too far
// off for corrections to come closer.
bool SparseMassKkt::solve_by_complement(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x,
                                        Vec& y) {
  y.setZero(nc_);
  x = b;
  masses_.solve(x);
  if (nc_ == 0) return true;
  const bool is_long = nc_ >= long_chain;
  // Of a row's dozen products. Long chains take their second correction in any case.
  const double enough = is_long ? 0 : 16 * eps * std::max(c.lpNorm<Eigen::Infinity>(), x.lpNorm<Eigen::Infinity>());
  const auto residual = [&](Vec& r) {
    r = -c;
    add_rows_times(bodies, 1, x, r);
    if (redundant_) remove_null_part(r);  // redundant rows that contradict each other, by drift or by their laws
    return r.lpNorm<Eigen::Infinity>();
  };
  int corrections = 0;
  bool soft = false;
  const auto correct = [&](const Vec& r) {
    complement_.solve(r, dy_);
    y += dy_;
    const bool tells = is_long && ++corrections == 2;
    if (tells) x_before_.swap(x);
    x = b;
    add_rows_force(bodies, -1, y, x);
    masses_.solve(x);
    if (tells) soft = is_soft(complement_.softness(r, dy_), x);
  };
  // Multipliers along a chain add up to accelerations a million times those that are left. Their round-off does not
  // fall by corrections, but the first one takes away what is smooth of it, to which a soft mechanism yields: 1e-9 of a
  // mast's accelerations.
  double of_forces = 0;
  const auto round_off = [&] { return of_forces = redundant_ ? 0 : 4 * eps * complement_.largest_share(y); };
  const double left = refine(residual, correct, enough, round_off, redundant_ ? 40 : 4, residual_);
  if (redundant_) minimise_norm(y);  // round-off over eps has moved it along the null space
  const bool astray =
      is_long && left > 1e3 * of_forces && left > 1e3 * (round_off() + 4 * eps * x.lpNorm<Eigen::Infinity>());
  return !soft && !astray;
}

bool SparseMassKkt::is_soft(double softness, const Vec& x) const {
  if (softness >= may_be_soft) return false;
  const double change = (x - x_before_).lpNorm<Eigen::Infinity>();
  return softness < soft_chain || change > trusted_change * x.lpNorm<Eigen::Infinity>();
}

namespace {

bool have_one_pattern(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B) {
  return A.rows() == B.rows() && A.nonZeros() == B.nonZeros() &&
         std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
         std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

}  // namespace

bool SparseIterationKkt::factorise(const Eigen::SparseMatrix<double>& full, int nv) {
  const bool same_pattern = nv == nv_ && have_one_pattern(full, full_);
  const int nc = int(full.rows()) - nv;
  full_ = full;
  regular_ = full;
  nv_ = nv;
  double S = 0, G = 0;
  for (int j = 0; j < nv; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(full, j); it; ++it)
      (it.row() < nv ? S : G) = std::max(it.row() < nv ? S : G, std::abs(it.value()));
  eps_ = S > 0 ? regularisation(nc) * G * G / S : 0;
  for (int i = 0; i < nc; ++i) regular_.coeffRef(nv + i, nv + i) -= eps_;
  regular_.makeCompressed();
  if (!same_pattern) lu_.analyzePattern(regular_);
  lu_.factorize(regular_);
  failed_ = lu_.info() != Eigen::Success;
  redundant_ = soft_ = false;
  if (nc > 0 && nc < long_from && !failed_ && eps_ > 0) judge_rows(nc);
  return !failed_;
}

// eps^2 (C + eps)^-2 y, C = G S^-1 W^T, keeps of y what lies in the rows' null space, and little else. The matrix takes
// (0, -r) to (-S^-1 W^T y, y) with y = (C + eps)^-1 r: the head is what the tail does to x.
void SparseIterationKkt::find_null_part(const Eigen::Ref<const Vec>& y) {
  null_part_.setZero(nv_ + y.size());
  null_part_.tail(y.size()) = y;
  for (int twice = 0; twice < 2; ++twice) {
    null_part_.head(nv_).setZero();
    null_part_ = (-eps_ * lu_.solve(null_part_)).eval();
  }
}

// Whether that part, of entries in no order, changes when it is taken again. It does not where rows are redundant or
// independent.
void SparseIterationKkt::judge_rows(int nc) {
  constexpr double golden = 0.61803398874989485, noticed = 1e-5;
  residual_.resize(nc);
  for (int i = 0; i < nc; ++i) residual_[i] = 1 + std::fmod(i * golden, 1.0);
  const double least = noticed * residual_.norm();
  find_null_part(residual_);
  if (!(null_part_.tail(nc).norm() > least)) return;
  redundant_ = true;
  residual_ = null_part_.tail(nc);
  find_null_part(residual_);
  soft_ = (null_part_.tail(nc) - residual_).norm() > least;
}

// Solutions leave their round-off over eps along the rows' null space, and so do the passes themselves.
// Forces stay balanced where rows depend on others but for a little: x follows.
void SparseIterationKkt::minimise_norm(int nc) {
  constexpr int passes = 2;
  for (int pass = 0; pass < passes; ++pass) {
    find_null_part(solution_.tail(nc));
    solution_ -= null_part_;
  }
}

double SparseIterationKkt::solve_and_refine() {
  solution_ = lu_.solve(right_);
  solves_ = 1;
  const auto residual = [&](Vec& r) {
    r = right_;
    r.noalias() -= full_ * solution_;
    return r.norm();
  };
  const auto correct = [&](const Vec& r) { solution_ += lu_.solve(r), ++solves_; };
  return refine(
      residual, correct, 1e-15 * right_.norm(), [] { return 0.0; }, 40, residual_);
}

// Soft rows are taken for redundant, all the more the softer they are: c does not ask for them, and y does nothing
// along them.
double SparseIterationKkt::solve_without_soft_rows(int nc) {
  constexpr int passes = 3;  // each leaves of rows with sigma^2 < eps/10 a fifth at most
  for (int i = 0; i < passes; ++i) {
    find_null_part(right_.tail(nc));
    right_.tail(nc) -= null_part_.tail(nc);
  }
  const double left = solve_and_refine();
  for (int i = 0; i < passes; ++i) {
    find_null_part(solution_.tail(nc));
    solution_ -= null_part_;
  }
  return left;
}

bool SparseIterationKkt::solve(const Vec& b, const Vec& c, Vec& x, Vec& y) {
  if (failed_ || !b.allFinite() || !c.allFinite()) return false;
  right_.resize(b.size() + c.size());
  right_ << b, c;
  const double left = soft_ ? solve_without_soft_rows(int(c.size())) : solve_and_refine();
  const bool reached = left <= 1e-6 * right_.norm();
  if (reached && redundant_ && !soft_) minimise_norm(int(c.size()));
  x = solution_.head(nv_);
  y = solution_.tail(c.size());
  if (!solution_.allFinite()) return false;
  if (reached) return true;
  // What no x reaches is left: where redundant rows differ, by round-off or as far as Newton's iteration still has to
  // go. Each solution
  // has added it to y, along the rows' null space.
  if (!soft_ && eps_ > 0) y += solves_ / eps_ * residual_.tail(c.size());
  const double of_rows = residual_.tail(c.size()).norm();
  const double of_forces = residual_.head(nv_).norm();
  residual_.head(nv_).setZero();
  right_.noalias() = full_.transpose() * residual_;
  // Reactions larger than what they balance, as near a singular position, leave their round-off.
  const double size = full_.norm(), round_off = 1e-13 * size + 16 * eps * size * y.norm();
  return of_forces <= 1e-6 * b.norm() + round_off && right_.head(nv_).norm() <= parting * of_rows;
}

}  // namespace trammel::numerics
