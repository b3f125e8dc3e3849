#include "scene/tabulated_law.hpp"

#include <algorithm>

#include <Eigen/LU>

namespace trammel {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Third and fourth derivative of a quintic piece at one of its ends, as  step + left (v_0, h a_0) + right (v_1, h a_1),
// times h^2 and h^3.
struct Bend {
  Vector2d step;
  Matrix2d left, right;
};
Bend bend_at_begin(double rise) {  // rise = (x_1 - x_0) / h
  return {rise * Vector2d(60, -360), Matrix2d{{-36, -9}, {192, 36}}, Matrix2d{{-24, 3}, {168, -24}}};
}
Bend bend_at_end(double rise) {
  return {rise * Vector2d(60, 360), Matrix2d{{-24, -3}, {-168, -24}}, Matrix2d{{-36, 9}, {-192, 36}}};
}

// (v_i, a_i) of the quintic spline: at each inner row the bend at the end of the piece before equals the one at the beginning
// of the piece after, a block tridiagonal system, solved from both ends' rest.
std::vector<Vector2d> slopes_of_spline(const std::vector<double>& t, const std::vector<double>& x) {
  const std::size_t n = t.size();
  std::vector<Vector2d> u(n, Vector2d::Zero()), right(n);
  std::vector<Matrix2d> upper(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h = t[i] - t[i - 1], k = t[i + 1] - t[i];
    const Bend before = bend_at_end((x[i] - x[i - 1]) / h), after = bend_at_begin((x[i + 1] - x[i]) / k);
    // Rows in units of the pieces before: third derivative times h^2, fourth times h^3; columns v and a.
    const double q = h / k;
    const Eigen::DiagonalMatrix<double, 2> scaled(q * q, q * q * q), columns_h(1, h), columns_k(1, k);
    const Matrix2d lower = before.left * columns_h;
    Matrix2d middle = Matrix2d(before.right * columns_h) - Matrix2d(scaled * after.left * columns_k);
    upper[i] = -Matrix2d(scaled * after.right * columns_k);
    right[i] = scaled * after.step - before.step;
    if (i > 1) {
      middle -= lower * upper[i - 1];
      right[i] -= lower * right[i - 1];
    }
    const Eigen::FullPivLU<Matrix2d> pivot(middle);
    upper[i] = pivot.solve(Matrix2d(upper[i]));
    right[i] = pivot.solve(Vector2d(right[i]));
  }
  for (std::size_t i = n - 1; i-- > 1;) u[i] = right[i] - upper[i] * u[i + 1];
  return u;
}

// Second derivatives of the natural cubic spline through (t_i, y_i).
std::vector<double> bends_of_natural_spline(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> m(n, 0), upper(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h = t[i] - t[i - 1], k = t[i + 1] - t[i];
    const double pivot = 2 * (h + k) - h * upper[i - 1];
    upper[i] = k / pivot;
    m[i] = (6 * ((y[i + 1] - y[i]) / k - (y[i] - y[i - 1]) / h) - h * m[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] -= upper[i] * m[i + 1];
  return m;
}

}  // namespace

TabulatedLaw TabulatedLaw::of_values(std::vector<double> t, std::vector<double> x) {
  TabulatedLaw law;
  for (const Vector2d& slope : slopes_of_spline(t, x)) {
    law.v_.push_back(slope[0]);
    law.a_.push_back(slope[1]);
  }
  law.t_ = std::move(t), law.x_ = std::move(x);
  return law;
}

TabulatedLaw TabulatedLaw::of_accelerations(std::vector<double> t, std::vector<double> a) {
  const std::vector<double> m = bends_of_natural_spline(t, a);
  TabulatedLaw law;
  double x = 0, v = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i > 0) {
      const double h = t[i] - t[i - 1];
      x += h * v + h * h * ((2 * a[i - 1] + a[i]) / 6 - h * h * (8 * m[i - 1] + 7 * m[i]) / 360);
      v += h * ((a[i - 1] + a[i]) / 2 - h * h * (m[i - 1] + m[i]) / 24);
    }
    law.x_.push_back(x), law.v_.push_back(v);
  }
  law.t_ = std::move(t), law.a_ = std::move(a);
  return law;
}

TimeFunction::Jet TabulatedLaw::jet(double t) const {
  if (!(t >= t_.front())) return {x_.front(), 0, 0};
  if (t > t_.back()) return {x_.back() + v_.back() * (t - t_.back()), v_.back(), 0};
  const auto above = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  const auto j = std::size_t(above - t_.begin()), i = j - 1;
  const double h = t_[j] - t_[i], s = (t - t_[i]) / h;
  // Differences of value, rate and second derivative to what the quadratic of the left end says at the right end.
  const double dx = x_[j] - x_[i] - h * v_[i] - h * h / 2 * a_[i], dv = h * (v_[j] - v_[i] - h * a_[i]),
               da = h * h * (a_[j] - a_[i]);
  const double c3 = 10 * dx - 4 * dv + da / 2, c4 = -15 * dx + 7 * dv - da, c5 = 6 * dx - 3 * dv + da / 2;
  return {x_[i] + h * s * (v_[i] + h * s * a_[i] / 2) + s * s * s * (c3 + s * (c4 + s * c5)),
          v_[i] + h * s * a_[i] + s * s * (3 * c3 + s * (4 * c4 + s * 5 * c5)) / h,
          a_[i] + s * (6 * c3 + s * (12 * c4 + s * 20 * c5)) / (h * h)};
}

}  // namespace trammel
