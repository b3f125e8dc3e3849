// Rows as stiff springs in the fronts of frontal_kkt.hpp. No row gives a pivot: a front eliminates all of its unknowns
// from K + k C^T C, where C are its own rows.
#include <algorithm>
#include <numeric>

#include "linear/dense/short_sums.hpp"
#include "linear/fronts/frontal_kkt.hpp"

namespace trammel::numerics {

double FrontalKkt::factorise_springs(const std::vector<BodyBlock>& bodies, int nc, bool identity, double softness) {
  lay_out(bodies, nc, true);
  identity_ = identity;
  stiffness_ = least_mass(bodies) / softness;
  return eliminate_fronts(bodies) ? 1 / stiffness_ : 0;
}

void FrontalKkt::solve_springs(const std::vector<BodyBlock>& bodies, double eps, const Vec& b, const Vec& c, Vec& x,
                               Vec& y) {
  merge(bodies, b, c);
  approach(1 / eps);
  y.setZero(c.size());
  expand(b, x, y);
}

double FrontalKkt::least_mass(const std::vector<BodyBlock>& bodies) {
  Vec diagonal = Vec::Zero(layout_.merged().count());
  for (const BodyBlock& body : bodies)
    for (Eigen::Index j = 0; j < body.M.rows(); ++j)
      diagonal(layout_.merged().of(body.v0 + int(j))) += identity_ ? 1 : body.M(j, j);
  return diagonal.size() > 0 ? diagonal.minCoeff() : 1;
}

void FrontalKkt::keep_rows(std::size_t f) {
  const FrontLayout::Front& front = layout_.fronts()[f];
  place_factors(f, 0, 0);
  const int n = front.unknowns, *const unknowns = layout_.unknowns(front);
  int* const columns = columns_.data() + front.first_unknown;
  std::iota(columns, columns + n, 0);
  if (f == 0) entries_.clear(), entries_end_.clear();
  const double* row = rows_.data();
  for (int i = 0; i < front.own_rows; ++i, row += n) {
    for (int j = 0; j < n; ++j)
      if (row[j] != 0) entries_.push_back({unknowns[j], row[j]});
    entries_end_.push_back(entries_.size());
  }
}

void FrontalKkt::add_springs(std::size_t f) {
  const FrontLayout::Front& front = layout_.fronts()[f];
  const int n = front.unknowns;
  const double* row = rows_.data();
  for (int i = 0; i < front.own_rows; ++i, row += n)
    for (int j = 0; j < n; ++j)
      if (row[j] != 0) add(n - j, stiffness_ * row[j], row + j, K_.data() + j * n + j);
}

// The method of multipliers: each solution reduces the violation of the rows by x, and y approaches their forces. It
// ends when the remaining change, if it decreases at the rate of the violation, is negligible: changes that would
// continue ever more slowly are rounding of the rows in directions that they hardly see. The second solution refines
// the first one with y unchanged: its residual, rounded at k times the size of the masses, would enter y in such
// directions and decay slowly. Later ones are small.
void FrontalKkt::approach(double k) {
  constexpr int most = 40;
  constexpr double settled = 1e-10, slow = 0.9, visible = 1e-6;
  const double apart = offset_.lpNorm<Eigen::Infinity>();
  X_.setZero(B_.size()), Y_ = k * C_, c_.resize(C_.size());  // Y: 0 after the first push
  double violated = 0, change = 0;
  for (int i = 0; i < most; ++i) {
    b_ = B_;
    push_by_rows(k, i != 1);
    const double shrinks = c_.lpNorm<Eigen::Infinity>() / violated;
    const double size = std::max(apart, X_.lpNorm<Eigen::Infinity>());
    if (i > 2 && (!(shrinks < slow) || change * shrinks / (1 - shrinks) <= settled * size)) break;
    violated = c_.lpNorm<Eigen::Infinity>();
    solve_once(dX_, dY_);
    X_ += dX_;
    change = dX_.lpNorm<Eigen::Infinity>();
  }
  // Contradictions of rows add a part without effect to y. No caller needs y if rows alone are corrected (b = 0).
  if (!B_.isZero(0) && k * c_.lpNorm<Eigen::Infinity>() > visible * Y_.lpNorm<Eigen::Infinity>())
    remove_null_part(k, Y_);
}

// c_ = C - G X,  Y -= k c_ if it is `taken`,  b_ -= M X + G^T (Y - k c_)
void FrontalKkt::push_by_rows(double k, bool taken) {
  const Entry* entry = entries_.data();
  for (std::size_t i = 0; i < entries_end_.size(); ++i) {
    const Entry *const begin = entry, *const end = entries_.data() + entries_end_[i];
    double missed = C_[Eigen::Index(i)], &push = Y_[Eigen::Index(i)];
    for (; entry != end; ++entry) missed -= entry->value * X_[entry->unknown];
    c_[Eigen::Index(i)] = missed;
    if (taken) push -= k * missed;
    for (const Entry* e = begin; e != end; ++e) b_[e->unknown] -= (push - k * missed) * e->value;
  }
  subtract_masses_times(X_, b_);
}

// 1 - k G (M + k G^T G)^-1 G^T keeps the null part of Y and reduces the rest; applied twice it leaves only the null
// part. Round-off requires more passes.
void FrontalKkt::remove_null_part(double k, Vec& Y) {
  for (int pass = 0; pass < 3; ++pass) {
    left_rows_ = Y;
    for (int twice = 0; twice < 2; ++twice) {
      b_.setZero(B_.size());
      subtract_rows_force(-k * left_rows_, b_);
      solve_once(dX_, dY_);
      subtract_rows_times(dX_, left_rows_);
    }
    Y -= left_rows_;
  }
}

void FrontalKkt::subtract_rows_times(const Vec& X, Vec& from) {
  const Entry* entry = entries_.data();
  for (std::size_t i = 0; i < entries_end_.size(); ++i)
    for (; entry != entries_.data() + entries_end_[i]; ++entry)
      from[Eigen::Index(i)] -= entry->value * X[entry->unknown];
}

void FrontalKkt::subtract_rows_force(const Vec& Y, Vec& from) {
  const Entry* entry = entries_.data();
  for (std::size_t i = 0; i < entries_end_.size(); ++i)
    for (; entry != entries_.data() + entries_end_[i]; ++entry)
      from[entry->unknown] -= entry->value * Y[Eigen::Index(i)];
}

}  // namespace trammel::numerics
