// The solutions of frontal_kkt.hpp: right sides are passed up from front to front (forward sweep), unknowns and
// multipliers down (backward sweep). They are refined in the unknowns of the fronts: merged unknowns and rows of length
// one.
#include <algorithm>
#include <limits>

#include "linear/dense/fixed_sizes.hpp"
#include "linear/dense/prefetch.hpp"
#include "linear/dense/refinement.hpp"
#include "linear/dense/short_sums.hpp"
#include "linear/fronts/frontal_kkt.hpp"

namespace trammel::numerics {

// t = P c,  b_r -= S^T b_1 + W^T t,  u = b_1 - K_11 t;  z = L^-1 b_2, b_B -= V^T z.
void FrontalKkt::forward(std::size_t k) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Parts p = parts(k);
  const int r = p.r, rest = p.rest;
  double* const w = w_.data();
  int m = 0;
  for (const double* own = c_.data() + front.first_row; m < front.own_rows; ++m) w[m] = own[m];
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Below below = passed_by(child);
    for (int i = 0; i < below.passed; ++i) w[m++] = below.passed_right[i];
  }
  for (int i = 0; i < p.passed; ++i) p.passed_right[i] = dot(m, p.Q + i * m, w);
  double* const b = scratch_.data();
  for (int j = 0; j < rest; ++j) b[j] = b_(p.unknowns[p.columns[r + j]]);
  for (int i = 0; i < r; ++i) {
    p.t[i] = dot(m, p.P(i), w);
    p.u[i] = b_(p.unknowns[p.columns[i]]);
    add(rest, -p.u[i], p.S(i), b);
    add(rest, -p.t[i], p.W + i * rest, b);
  }
  for (int i = 0; i < r; ++i) add(r, -p.t[i], p.K11 + i * r, p.u);
  for (int j = 0; j < p.free; ++j) {
    const double* const column = p.LV + j * rest;
    p.z[j] = b[j] / column[j];
    add(rest - j - 1, -p.z[j], column + j + 1, b + j + 1);
  }
  for (int j = p.free; j < rest; ++j) b_(p.unknowns[p.columns[r + j]]) = b[j];
}

// x_2 = L^-T (z - V x_B),  x_1 = t - S x_r,  y = P^T (u - W x_r) plus the parent's part for rows passed on.
void FrontalKkt::backward(std::size_t k, Vec& X, Vec& Y) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Parts p = parts(k);
  const int r = p.r, rest = p.rest;
  double* const x = scratch_.data();
  for (int j = p.free; j < rest; ++j) x[j] = X(p.unknowns[p.columns[r + j]]);
  for (int j = p.free - 1; j >= 0; --j) {
    const double* const column = p.LV + j * rest;
    x[j] = (p.z[j] - dot(rest - j - 1, column + j + 1, x + j + 1)) / column[j];
    X(p.unknowns[p.columns[r + j]]) = x[j];
  }
  double* const w = w_.data();
  for (int i = 0; i < p.m; ++i) w[i] = 0;
  for (int i = 0; i < r; ++i) {
    X(p.unknowns[p.columns[i]]) = p.t[i] - dot(rest, p.S(i), x);
    add(p.m, p.u[i] - dot(rest, p.W + i * rest, x), p.P(i), w);
  }
  for (int i = 0; i < p.passed; ++i) add(p.m, p.passed_right[i], p.Q + i * p.m, w);
  int m = 0;
  for (double* own = Y.data() + front.first_row; m < front.own_rows; ++m) own[m] = w[m];
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Below below = passed_by(child);
    for (int i = 0; i < below.passed; ++i) below.passed_right[i] = w[m++];
  }
}

void FrontalKkt::prefetch_factors(std::size_t k, Way way) {
  const double* const begin = store_.data() + places_[k].factors;
  const Parts p = parts(k);
  const std::size_t bytes = std::size_t(p.K11 + p.r * p.r - begin) * sizeof(double);
  way == Way::up ? prefetch(begin, bytes) : prefetch_down(begin, bytes);
}

// From b_ and c_; b_ is overwritten.
void FrontalKkt::solve_once(Vec& X, Vec& Y) {
  X.resize(b_.size()), Y.resize(c_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k + 1 < places_.size()) prefetch_factors(k + 1, Way::up);
    forward(k);
  }
  for (std::size_t k = places_.size(); k-- > 0;) {
    if (k > 0) prefetch_factors(k - 1, Way::down);
    backward(k, X, Y);
  }
}

bool FrontalKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  merge(bodies, b, c);
  const bool holds = refine();
  y.setZero(c.size());
  expand(b, x, y);
  return holds;
}

bool FrontalKkt::refine() {
  struct Equations {
    FrontalKkt& kkt;
    double apart, size = 0;
    // Judged by the corrections only: errors in soft directions do not show in the residual.
    double residual() { return kkt.find_residuals(), 1; }
    double correction() {
      kkt.solve_once(kkt.dX_, kkt.dY_);
      const double change = kkt.dX_.lpNorm<Eigen::Infinity>();
      size = std::max(apart, kkt.X_.lpNorm<Eigen::Infinity>());
      return change > 0 ? change / size : change;
    }
    void apply() { kkt.X_ += kkt.dX_, kkt.Y_ += kkt.dY_; }
  };
  constexpr double good = 1e-7, lost = 1e-6;  // of corrections: leaves an error of its square; too large to be trusted
  constexpr Refinement by_corrections{
      .most = 4, .enough = 0, .falls = std::numeric_limits<double>::infinity(), .settled = good, .contracts = 0.1};
  b_ = B_, c_ = C_;
  solve_once(X_, Y_);
  Equations equations{*this, offset_.lpNorm<Eigen::Infinity>()};
  const Refined refined = numerics::refine(equations, by_corrections);
  missed_ = find_missed(equations.size);
  return refined.correction <= lost;
}

// The residual before the last correction is an upper bound and often small enough.
double FrontalKkt::find_missed(double size) {
  constexpr double of_products = 1e-14;
  const auto missed = [&] { return c_.size() > 0 ? c_.lpNorm<Eigen::Infinity>() / size : 0; };
  if (dependent_ == 0 || !(missed() > of_products)) return 0;
  find_residuals();
  return missed() > of_products ? missed() : 0;
}

namespace {

// from -= M x, both at unknowns[map[i]]
void subtract_mass(const double* M, int size, const int* map, const int* unknowns, const double* x, double* from) {
  const auto of_fixed = [&](auto n) {
    int at[n];
    double sum[n] = {};
    for (int i = 0; i < n; ++i) at[i] = unknowns[map[i]];
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) sum[i] += M[j * n + i] * x[at[j]];
    for (int i = 0; i < n; ++i) from[at[i]] -= sum[i];
  };
  if (with_fixed_size(size, of_fixed)) return;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) from[unknowns[map[i]]] -= M[j * size + i] * x[unknowns[map[j]]];
}

}  // namespace

void FrontalKkt::subtract_masses_times(const Vec& X, Vec& from) const {
  for (std::size_t k = 0; k < places_.size(); ++k) subtract_masses_times(k, X, from);
}

void FrontalKkt::subtract_masses_times(std::size_t k, const Vec& X, Vec& from) const {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const int* const unknowns = layout_.unknowns(front);
  std::size_t piece_at = std::size_t(front.masses.begin);
  for (const FrontLayout::Source& source : layout_.masses(front)) {
    const int* const map = layout_.map(source.map);
    if (identity_)
      for (int j = 0; j < source.size; ++j) from[unknowns[map[j]]] -= X[unknowns[map[j]]];
    else
      subtract_mass(pieces_.of(piece_at++), source.size, map, unknowns, X.data(), from.data());
  }
}

// b_ = B - M X - G^T Y,  c_ = C - G X
void FrontalKkt::find_residuals() {
  b_ = B_, c_ = C_;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k + 1 < places_.size()) pieces_.prefetch(k + 1);
    const FrontLayout::Front& front = layout_.fronts()[k];
    const int* const unknowns = layout_.unknowns(front);
    std::size_t piece_at = std::size_t(front.rows.begin);
    for (const FrontLayout::Source& source : layout_.rows(front)) {
      const double* const piece = pieces_.of(piece_at++);
      const int row = front.first_row + source.row, *const map = layout_.map(source.map);
      const double scale = scale_[std::size_t(row)], force = scale * Y_(row);
      double along = 0;
      for (int j = 0; j < source.size; ++j) {
        if (map[j] < 0) continue;
        along += piece[j] * X_(unknowns[map[j]]);
        b_(unknowns[map[j]]) -= force * piece[j];
      }
      c_(row) -= scale * along;
    }
    subtract_masses_times(k, X_, b_);
  }
}

// Forms B_ and C_, and offset_, the part of x that the rows of merged unknowns prescribe.
void FrontalKkt::merge(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c) {
  const MergedUnknowns& merged = layout_.merged();
  merged.offsets(c, offset_);
  const bool apart = !offset_.isZero(0);
  if (apart) {
    left_ = b, left_rows_ = c;
    if (identity_)
      left_ -= offset_;
    else
      add_mass_times(bodies, -1, offset_, left_);
    add_rows_times(bodies, -1, offset_, left_rows_);
  }
  const Vec &forces = apart ? left_ : b, &rows = apart ? left_rows_ : c;
  B_.setZero(merged.count());
  for (Eigen::Index j = 0; j < b.size(); ++j) B_(merged.of(int(j))) += forces(j);
  C_.resize(Eigen::Index(layout_.all_own_rows()));
  for (Eigen::Index i = 0; i < C_.size(); ++i) C_(i) = rows(layout_.own_row(std::size_t(i))) * scale_[std::size_t(i)];
}

// x and y from X_ and Y_; the multipliers of merging rows are the residual b - M x - G^T y.
void FrontalKkt::expand(const Vec& b, Vec& x, Vec& y) {
  const MergedUnknowns& merged = layout_.merged();
  x = offset_;
  for (Eigen::Index j = 0; j < x.size(); ++j) x(j) += X_(merged.of(int(j)));
  left_ = b;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k + 1 < places_.size()) pieces_.prefetch(k + 1);
    const FrontLayout::Front& front = layout_.fronts()[k];
    for (int i = front.first_row; i < front.first_row + front.own_rows; ++i)
      y(layout_.own_row(std::size_t(i))) = Y_(i) * scale_[std::size_t(i)];
    std::size_t piece_at = std::size_t(front.rows.begin);
    for (const FrontLayout::Source& source : layout_.rows(front)) {
      const int i = front.first_row + source.row;
      add(source.size, -Y_(i) * scale_[std::size_t(i)], pieces_.of(piece_at++), left_.data() + source.v0);
    }
    for (const FrontLayout::Source& source : layout_.masses(front)) {
      const std::size_t mass = piece_at++;
      double* const forces = left_.data() + source.v0;
      for (int j = 0; j < source.size; ++j) {
        if (identity_)
          forces[j] -= x(source.v0 + j);
        else
          add(source.size, -x(source.v0 + j), pieces_.of(mass) + j * source.size, forces);
      }
    }
  }
  merged.multipliers(left_, y);
}

}  // namespace trammel::numerics
