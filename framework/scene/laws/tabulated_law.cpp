#include "scene/laws/tabulated_law.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace trammel {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Of the range of a column: its ends are one value, written with a few digits less than doubles have.
constexpr double same_value = 1e-9;

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

// Third and fourth derivatives of two adjacent pieces, in units of the first piece: times h^2 and times h^3.
struct Meeting {
  double h, k;  // lengths before and after
  Bend before, after;
  double q = h / k;
  Eigen::DiagonalMatrix<double, 2> scaled{q * q, q*q*q}, columns_h{1, h}, columns_k{1, k};  // columns: v and a

  Meeting(double x_0, double x_1, double x_2, double length_before, double length_after)
      : h(length_before),
        k(length_after),
        before(bend_at_end((x_1 - x_0) / h)),
        after(bend_at_begin((x_2 - x_1) / k)) {}

  Matrix2d lower() const { return before.left * columns_h; }
  Matrix2d middle() const { return Matrix2d(before.right * columns_h) - Matrix2d(scaled * after.left * columns_k); }
  Matrix2d upper() const { return -Matrix2d(scaled * after.right * columns_k); }
  Vector2d right() const { return scaled * after.step - before.step; }
};

// (v_i, a_i) of the quintic spline with those of both ends given: at each inner row the bend at the end of the piece
// before equals the one at the beginning of the piece after, a block tridiagonal system.
std::vector<Vector2d> slopes_of_spline(const std::vector<double>& t, const std::vector<double>& x,
                                       const Vector2d& ends) {
  const std::size_t n = t.size();
  std::vector<Vector2d> u(n, ends), right(n);
  std::vector<Matrix2d> upper(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Meeting at(x[i - 1], x[i], x[i + 1], t[i] - t[i - 1], t[i + 1] - t[i]);
    const Matrix2d lower = at.lower();
    Matrix2d middle = at.middle();
    right[i] = at.right();
    if (i > 1) {
      middle -= lower * upper[i - 1];
      right[i] -= lower * right[i - 1];
    } else {
      right[i] -= lower * ends;
    }
    const Eigen::FullPivLU<Matrix2d> pivot(middle);
    upper[i] = pivot.solve(at.upper());
    right[i] = pivot.solve(Vector2d(right[i]));
  }
  for (std::size_t i = n - 1; i-- > 1;) u[i] = right[i] - upper[i] * u[i + 1];
  return u;
}

// The same if the last row is the first one of the next period: the end values are chosen such that these derivatives
// agree there, too. The end values enter linearly, so that three splines determine them.
std::vector<Vector2d> slopes_of_periodic_spline(const std::vector<double>& t, const std::vector<double>& x) {
  const std::size_t n = t.size();
  const Meeting at(x[n - 2], x[n - 1], x[1], t[n - 1] - t[n - 2], t[1] - t[0]);
  const auto gap = [&](const Vector2d& ends) -> Vector2d {
    const std::vector<Vector2d> u = slopes_of_spline(t, x, ends);
    return at.lower() * u[n - 2] + at.middle() * ends + at.upper() * u[1] - at.right();
  };
  const Vector2d at_rest = gap(Vector2d::Zero());
  const double time = t[n - 1] - t[0];  // a has its unit
  Matrix2d by_ends;
  by_ends << gap({1, 0}) - at_rest, gap({0, 1 / time}) - at_rest;
  const Vector2d ends = by_ends.fullPivLu().solve(-at_rest);
  return slopes_of_spline(t, x, {ends[0], ends[1] / time});
}

bool ends_where_it_began(const std::vector<double>& x) {
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  return std::abs(x.back() - x.front()) <= same_value * (*most - *least);
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

TabulatedLaw TabulatedLaw::of_values(std::vector<double> t, std::vector<double> x, Beyond beyond) {
  TabulatedLaw law;
  law.beyond_ = beyond;
  const bool periodic = beyond == Beyond::repeat && ends_where_it_began(x);
  if (periodic) x.back() = x.front();
  for (const Vector2d& slope : periodic ? slopes_of_periodic_spline(t, x) : slopes_of_spline(t, x, Vector2d::Zero())) {
    law.v_.push_back(slope[0]);
    law.a_.push_back(slope[1]);
  }
  law.t_ = std::move(t), law.x_ = std::move(x);
  return law;
}

TabulatedLaw TabulatedLaw::of_accelerations(std::vector<double> t, std::vector<double> a, Beyond beyond) {
  const std::vector<double> m = bends_of_natural_spline(t, a);
  TabulatedLaw law;
  law.beyond_ = beyond, law.of_accelerations_ = true;
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
  if (beyond_ == Beyond::repeat) return repeated(t);
  if (t >= t_.front() && t <= t_.back()) return between_rows(t);
  if (beyond_ == Beyond::zero && !of_accelerations_) return {};
  return held(t < t_.front() ? 0 : t_.size() - 1, t);
}

// Continues the law beyond an end: with the value or the acceleration of that row, or with the velocity there and no
// acceleration.
TimeFunction::Jet TabulatedLaw::held(std::size_t row, double t) const {
  const double s = t - t_[row], v = v_[row], a = of_accelerations_ && beyond_ == Beyond::hold ? a_[row] : 0;
  return {x_[row] + s * (v + s * a / 2), v + s * a, a};
}

double TabulatedLaw::period(double t) const {
  return std::floor((t - t_.front()) / (t_.back() - t_.front()));
}

TimeFunction::Jet TabulatedLaw::repeated(double t) const {
  const double length = t_.back() - t_.front(), n = period(t);
  const double s = std::clamp(t - t_.front() - n * length, 0.0, length);
  TimeFunction::Jet at = between_rows(t_.front() + s);
  if (!of_accelerations_) return at;
  const double gained = v_.back();  // velocity gained in each period
  at.value += n * x_.back() + gained * (n * (n - 1) / 2 * length + n * s);
  at.rate += n * gained;
  return at;
}

// Values may jump where a piece of the law ends; position and velocity integrated from accelerations do not.
void TabulatedLaw::branches(double t, std::vector<double>& way) const {
  way.clear();
  if (of_accelerations_) return;
  if (beyond_ == Beyond::repeat) way.push_back(period(t));
  if (beyond_ == Beyond::zero) way.push_back(t < t_.front() ? -1 : t > t_.back() ? 1 : 0);
}

TimeFunction::Code::Span TabulatedLaw::span() const {
  if (beyond_ == Beyond::unsaid) return {t_.front(), t_.back()};
  return {};
}

bool TabulatedLaw::is_periodic() const {
  return beyond_ == Beyond::repeat && !of_accelerations_ && x_.front() == x_.back();
}

bool TabulatedLaw::equals(const Code& other) const {
  const auto* law = dynamic_cast<const TabulatedLaw*>(&other);
  return law && law->beyond_ == beyond_ && law->t_ == t_ && law->x_ == x_ && law->v_ == v_ && law->a_ == a_;
}

TabulatedLaw::Piece TabulatedLaw::piece(std::size_t j) const {
  const std::size_t i = j - 1;
  const double h = t_[j] - t_[i];
  // Value, rate and second derivative at the right end minus those of the left end's quadratic there.
  const double dx = x_[j] - x_[i] - h * v_[i] - h * h / 2 * a_[i], dv = h * (v_[j] - v_[i] - h * a_[i]),
               da = h * h * (a_[j] - a_[i]);
  const double c3 = 10 * dx - 4 * dv + da / 2, c4 = -15 * dx + 7 * dv - da, c5 = 6 * dx - 3 * dv + da / 2;
  return {h, {x_[i], h * v_[i], h * h / 2 * a_[i], c3, c4, c5}};
}

TimeFunction::Jet TabulatedLaw::between_rows(double t) const {
  const auto above = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
  const auto j = std::size_t(above - t_.begin()), i = j - 1;
  const auto [h, c] = piece(j);
  const double s = (t - t_[i]) / h, c3 = c[3], c4 = c[4], c5 = c[5];
  return {x_[i] + h * s * (v_[i] + h * s * a_[i] / 2) + s * s * s * (c3 + s * (c4 + s * c5)),
          v_[i] + h * s * a_[i] + s * s * (3 * c3 + s * (4 * c4 + s * 5 * c5)) / h,
          a_[i] + s * (6 * c3 + s * (12 * c4 + s * 20 * c5)) / (h * h)};
}

}  // namespace trammel
