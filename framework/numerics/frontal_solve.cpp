// The solutions of frontal_kkt.hpp: right sides go up from front to front, unknowns and multipliers come down.
#include <algorithm>

#include "numerics/frontal_kkt.hpp"
#include "numerics/small_loops.hpp"

namespace trammel::numerics {

// t = R^-1 c_1,  b_r -= S^T b_1 + W^T t,  u = b_1 - K_11 t;  z = L^-1 b_2, b_B -= V^T z.
void FrontalKkt::forward(std::size_t k, const Vec& c) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Parts p = parts(k);
  const int r = p.r, rest = p.rest;
  double* w = w_.data();
  for (int i = 0; i < front.own_rows; ++i)
    *w++ = c(layout_.own_rows(front)[i]) * scale_[std::size_t(front.first_row + i)];
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
void FrontalKkt::backward(std::size_t k, Vec& y) {
  const FrontLayout::Front& front = layout_.fronts()[k];
  const Parts p = parts(k);
  const int r = p.r, rest = p.rest;
  double* const x = scratch_.data();
  for (int j = p.free; j < rest; ++j) x[j] = X_(p.unknowns[p.columns[r + j]]);
  for (int j = p.free - 1; j >= 0; --j) {
    const double* const column = p.LV + j * rest;
    x[j] = (p.z[j] - dot(rest - j - 1, column + j + 1, x + j + 1)) / column[j];
    X_(p.unknowns[p.columns[r + j]]) = x[j];
  }
  double* const w = w_.data();
  std::fill_n(w, p.m, 0.0);
  for (int i = 0; i < r; ++i) {
    X_(p.unknowns[p.columns[i]]) = p.t[i] - dot(rest, p.S(i), x);
    w[i] = p.u[i] - dot(rest, p.W + i * rest, x);
  }
  for (int i = 0; i < r; ++i) {
    w[i] /= p.R(i, i);
    add(r - 1 - i, -w[i], p.C + i * p.n + i + 1, w + i + 1);
  }
  for (int i = 0; i < p.passed; ++i) w[r + i] = p.passed_right[i] * p.passed_scale[i];
  rows_of(places_[k], p.n).apply_back(r + p.passed, w);
  for (int i = 0; i < front.own_rows; ++i)
    y(layout_.own_rows(front)[i]) = w[i] * scale_[std::size_t(front.first_row + i)];
  const double* at = w + front.own_rows;
  for (const FrontLayout::Child& child : layout_.children(front)) {
    const Parts below = parts(std::size_t(child.front));
    std::copy_n(at, below.passed, below.passed_right);
    at += below.passed;
  }
}

void FrontalKkt::solve(const std::vector<BodyBlock>& bodies, const Vec& b, const Vec& c, Vec& x, Vec& y) {
  const auto subtract_mass = [&](const Vec& a, Vec& from) {
    if (identity_)
      from -= a;
    else
      add_mass_times(bodies, -1, a, from);
  };
  const MergedUnknowns& merged = layout_.merged();
  left_ = b, c_ = c;
  merged.offsets(c, offset_);
  if (!offset_.isZero(0)) {
    subtract_mass(offset_, left_);
    add_rows_times(bodies, -1, offset_, c_);
  }
  b_.setZero(merged.count());
  for (Eigen::Index j = 0; j < b.size(); ++j) b_(merged.of(int(j))) += left_(j);
  X_.resize(merged.count());
  y.setZero(c.size());
  for (std::size_t k = 0; k < places_.size(); ++k) forward(k, c_);
  for (std::size_t k = places_.size(); k-- > 0;) backward(k, y);
  x = offset_;
  for (Eigen::Index j = 0; j < x.size(); ++j) x(j) += X_(merged.of(int(j)));
  left_ = b;
  subtract_mass(x, left_);
  add_rows_force(bodies, -1, y, left_);
  merged.multipliers(left_, y);
}

}  // namespace trammel::numerics
