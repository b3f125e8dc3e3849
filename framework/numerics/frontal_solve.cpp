// The solutions of frontal_kkt.hpp: right sides go up from front to front, unknowns and multipliers come down. They are refined where
// the fronts are, in merged unknowns and rows at length one.
#include <algorithm>

#include "numerics/few_rows.hpp"
#include "numerics/frontal_kkt.hpp"
#include "numerics/small_loops.hpp"

namespace trammel::numerics {

// t = R^-1 c_1,  b_r -= S^T b_1 + W^T t,  u = b_1 - K_11 t;  z = L^-1 b_2, b_B -= V^T z.
void FrontalKkt::forward(std::size_t k) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Parts p = parts(k);
  const int r = p.r, rest = p.rest;
  double* w = std::copy_n(c_.data() + front.first_row, front.own_rows, w_.data());
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Parts below = parts(std::size_t(child.front));
    w = std::copy_n(below.passed_right, below.passed, w);
  }
  w = w_.data();
  rows_of(places_[k], p.n).apply(r + p.passed, w);
  for (int i = 0; i < p.passed; ++i) p.passed_right[i] = w[r + i] * p.passed_scale[i];

  std::copy_n(w, r, p.t);
  for (int i = r - 1; i >= 0; --i) {
    p.t[i] = (p.t[i] - dot(r - 1 - i, p.C + i * p.n + i + 1, p.t + i + 1)) / p.R(i, i);
    p.u[i] = b_(p.unknowns[p.columns[i]]);
  }
  double* const b = scratch_.data();
  for (int j = 0; j < rest; ++j) b[j] = b_(p.unknowns[p.columns[r + j]]);
  for (int i = 0; i < r; ++i) {
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

// x_2 = L^-T (z - V x_B),  x_1 = t - S x_r,  R^T y_1 = u - W x_r.
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
  std::fill_n(w, p.m, 0.0);
  for (int i = 0; i < r; ++i) {
    X(p.unknowns[p.columns[i]]) = p.t[i] - dot(rest, p.S(i), x);
    w[i] = p.u[i] - dot(rest, p.W + i * rest, x);
  }
  for (int i = 0; i < r; ++i) {
    w[i] /= p.R(i, i);
    add(r - 1 - i, -w[i], p.C + i * p.n + i + 1, w + i + 1);
  }
  for (int i = 0; i < p.passed; ++i) w[r + i] = p.passed_right[i] * p.passed_scale[i];
  rows_of(places_[k], p.n).apply_back(r + p.passed, w);
  std::copy_n(w, front.own_rows, Y.data() + front.first_row);
  const double* at = w + front.own_rows;
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Parts below = parts(std::size_t(child.front));
    std::copy_n(at, below.passed, below.passed_right);
    at += below.passed;
  }
}

// From b_ and c_; b_ is used up.
void FrontalKkt::solve_once(Vec& X, Vec& Y) {
  X.resize(b_.size()), Y.resize(c_.size());
  for (std::size_t k = 0; k < places_.size(); ++k) forward(k);
  for (std::size_t k = places_.size(); k-- > 0;) backward(k, X, Y);
}

bool FrontalKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  merge(bodies, b, c);
  const bool holds = refine(bodies);
  y.setZero(c.size());
  expand(bodies, b, x, y);
  return holds;
}

bool FrontalKkt::refine(const std::vector<BodyBlock>& bodies) {
  constexpr int most = 4;
  constexpr double good = 1e-7, lost = 1e-6;  // corrections: leave their square; too large to count on
  const double apart = offset_.lpNorm<Eigen::Infinity>();
  double change = 0, size = 0;
  b_ = B_, c_ = C_;
  solve_once(X_, Y_);
  for (int i = 0; i < most; ++i) {
    find_residuals(bodies);
    solve_once(dX_, dY_);
    change = dX_.lpNorm<Eigen::Infinity>(), size = std::max(apart, X_.lpNorm<Eigen::Infinity>());
    if (!(change < 0.1 * size)) break;
    X_ += dX_, Y_ += dY_;
    if (change <= good * size) break;
  }
  return change <= lost * size;
}

namespace {

// sum += M x, both at the places of `map`
void add_mass(const Mat& M, const int* map, const double* x, double* sum) {
  const double* column = M.data();
  const auto of_size = [&](auto n) {
    for (int j = 0; j < n; ++j, column += n) {
      const double by = x[map[j]];
      for (int i = 0; i < n; ++i) sum[map[i]] += by * column[i];
    }
  };
  if (!with_few(M.rows(), of_size)) of_size(int(M.rows()));
}

}  // namespace

// b_ = B - M X - G^T Y,  c_ = C - G X
void FrontalKkt::find_residuals(const std::vector<BodyBlock>& bodies) {
  b_ = B_, c_ = C_;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const FrontLayout::Front& front = layout_.fronts()[k];
    const int n = front.unknowns, *const unknowns = layout_.unknowns(front);
    double *const x = scratch_.data(), *const sum = x + n;
    for (int j = 0; j < n; ++j) x[j] = X_(unknowns[j]), sum[j] = 0;

    const double* piece = pieces_.data() + places_[k].pieces;
    for (const FrontLayout::Source& source : layout_.rows(front)) {
      const int row = front.first_row + source.row, *const map = layout_.map(source.map);
      const int size = int(bodies[std::size_t(source.body)].Gt.rows());
      const double scale = scale_[std::size_t(row)], force = scale * Y_(row);
      double along = 0;
      for (int j = 0; j < size; ++j) {
        if (map[j] < 0) continue;
        along += piece[j] * x[map[j]];
        sum[map[j]] += force * piece[j];
      }
      c_(row) -= scale * along;
      piece += size;
    }
    for (const FrontLayout::Source& source : layout_.masses(front)) {
      const Mat& M = bodies[std::size_t(source.body)].M;
      const int* const map = layout_.map(source.map);
      if (identity_)
        for (Eigen::Index j = 0; j < M.rows(); ++j) sum[map[j]] += x[map[j]];
      else
        add_mass(M, map, x, sum);
    }
    for (int j = 0; j < n; ++j) b_(unknowns[j]) -= sum[j];
  }
}

void FrontalKkt::subtract_mass(const std::vector<BodyBlock>& bodies, const Vec& a, Vec& from) {
  if (identity_)
    from -= a;
  else
    add_mass_times(bodies, -1, a, from);
}

// B_ and C_; offset_: of x from the merged unknowns.
void FrontalKkt::merge(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c) {
  const MergedUnknowns& merged = layout_.merged();
  left_ = b, left_rows_ = c;
  merged.offsets(c, offset_);
  if (!offset_.isZero(0)) {
    subtract_mass(bodies, offset_, left_);
    add_rows_times(bodies, -1, offset_, left_rows_);
  }
  B_.setZero(merged.count());
  for (Eigen::Index j = 0; j < b.size(); ++j) B_(merged.of(int(j))) += left_(j);
  C_.resize(Eigen::Index(layout_.all_own_rows()));
  for (Eigen::Index i = 0; i < C_.size(); ++i)
    C_(i) = left_rows_(layout_.own_row(std::size_t(i))) * scale_[std::size_t(i)];
}

// x and y from X_ and Y_, and the multipliers of the rows that merge.
void FrontalKkt::expand(const std::vector<BodyBlock>& bodies, const Vec& b, Vec& x, Vec& y) {
  const MergedUnknowns& merged = layout_.merged();
  x = offset_;
  for (Eigen::Index j = 0; j < x.size(); ++j) x(j) += X_(merged.of(int(j)));
  for (Eigen::Index i = 0; i < Y_.size(); ++i) y(layout_.own_row(std::size_t(i))) = Y_(i) * scale_[std::size_t(i)];
  left_ = b;
  subtract_mass(bodies, x, left_);
  add_rows_force(bodies, -1, y, left_);
  merged.multipliers(left_, y);
}

}  // namespace trammel::numerics
