// The course of an impact between two events, and the location of the next event, by extrapolated midpoint steps.
#include "simulate/impact/spring_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::simulate {

namespace {

constexpr double step_error = 2e-13;
constexpr int columns = 6, order = 2 * columns;
constexpr int most_steps = 20000;
constexpr double least_error = 1e-30;  // of a step, relative to `step_error`: keeps its power finite
// Times in units of the springs': a step that is taken whatever its error; a way between events that is no progress; a
// step that may hide an event inside; the longest step, and a course that does not end.
constexpr double shortest = 1e-12, no_progress = 1e-12, may_hide = 1e-3, longest = 1e9, endless = 1e8;
// Trials of the location of an event, a third of them by bisection if need be; of the step: a bracket at round-off.
constexpr int most_trials = 150;
constexpr double narrowest = 1e-15;
// In tolerances: an event whose function is below its negative has passed; where one is located, it is above.
constexpr double passed = 10;

// Where functions that are positive at lo and negative at hi are 0 first, each by the straight line through its ends.
double first_zero(double lo, const Vec& at_lo, double hi, const Vec& at_hi) {
  double first = hi;
  for (Eigen::Index j = 0; j < at_hi.size(); ++j)
    if (at_hi[j] < 0) first = std::min(first, hi - (hi - lo) * at_hi[j] / (at_hi[j] - at_lo[j]));
  return first;
}

}  // namespace

Vec SpringImpact::state() const {
  Vec y(2 * n_ + m_);
  y << x_, P_, lost_friction_;
  return y;
}

void SpringImpact::take(const Vec& y) {
  x_ = y.head(n_), P_ = y.segment(n_, m_), lost_friction_ = y.tail(n_);
  u_ = rates();
  for (Contact& c : contacts_)
    if (c.mode == Tangent::slides && slip(c, u_).norm() > 2 * slow_) c.slid = true;
}

void SpringImpact::forces(const Vec& y, const Vec& u, Vec& f) const {
  f.setZero(m_);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    if (!c.presses) continue;
    const double F = f[c.normal] = k_ * y[Eigen::Index(i)];
    if (c.mode != Tangent::slides) continue;
    const bool turns = t_ == 2 && c.slid;
    const Slip direction = turns ? Slip(slip(c, u).normalized()) : Slip(c.direction.head(t_));
    f.segment(c.tangent, t_) = -c.mu * F * direction;
  }
  if (sticking_.empty()) return;
  held_.noalias() = hold_ * f;
  f(sticking_) = held_;
}

void SpringImpact::derivative(const Vec& y, Vec& dy) {
  u_.noalias() = A_ * y.segment(n_, m_);
  u_ += u_before_;
  forces(y, u_, f_);
  dy.resize(y.size());
  dy.segment(n_, m_) = f_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    dy[Eigen::Index(i)] = c.presses ? -u_[c.normal] : 0;
    const bool slides = c.presses && c.mode == Tangent::slides;
    dy[n_ + m_ + Eigen::Index(i)] = slides ? -f_.segment(c.tangent, t_).dot(u_.segment(c.tangent, t_)) : 0;
  }
}

// True if a slip in space has turned by more than 60 degrees from u: it has then passed 0, where friction jumps.
bool SpringImpact::turned_from(const Vec& u) const {
  for (const Contact& c : contacts_) {
    if (t_ == 1 || !c.presses || c.mode != Tangent::slides || !c.slid) continue;
    const Slip s = slip(c, u), now = slip(c, u_);
    if (s.dot(now) < 0.5 * s.norm() * now.norm()) return true;
  }
  return false;
}

// False: friction jumps within the step.
bool SpringImpact::midpoint(const Vec& y, double h, int n, Vec& y_end) {
  const double d = h / n;
  derivative(y, dy_);
  const Vec u = u_;
  Vec before = y, now = y + d * dy_;
  bool smooth = true;
  for (int i = 1; i < n && smooth; ++i) {
    derivative(now, dy_);
    smooth = !turned_from(u);
    middle_ = before + 2 * d * dy_;
    before.swap(now), now.swap(middle_);
  }
  derivative(now, dy_);
  y_end = 0.5 * (before + now + d * dy_);
  return smooth && !turned_from(u);
}

// Returns the estimated error in units of `step_error`.
double SpringImpact::extrapolate(const Vec& y, double h, Vec& y_end) {
  std::vector<Vec> row(columns), last(columns);
  for (int j = 0; j < columns; ++j) {
    if (!midpoint(y, h, 2 * (j + 1), row[0])) {
      y_end = row[0];  // the shortest step is taken whatever its error
      return std::numeric_limits<double>::infinity();
    }
    for (int k = 1; k <= j; ++k) {
      const double ratio = double(j + 1) / double(j + 1 - k);
      row[std::size_t(k)] =
          row[std::size_t(k - 1)] + (row[std::size_t(k - 1)] - last[std::size_t(k - 1)]) / (ratio * ratio - 1);
    }
    row.swap(last);
  }
  y_end = last[columns - 1];
  const Vec off = y_end - last[columns - 2];
  double error = 0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    error = std::max(error, std::abs(off[i]) / std::max(v_, std::abs(y[i])));
    error = std::max(error, std::abs(off[n_ + m_ + i]) / (k_ * v_ * v_));
  }
  for (Eigen::Index i = 0; i < m_; ++i) error = std::max(error, std::abs(off[n_ + i]) * std::sqrt(A_(i, i) / k_) / v_);
  return error / step_error;
}

// True if a margin is negative only within the step, by the cubic through its ends.
bool SpringImpact::dips_within(const Vec& y, double h, const Vec& y_end) {
  Vec slope, slope_end;
  derivative(y, slope), derivative(y_end, slope_end);
  const auto between = [&](double s) {
    const double r = 1 - s;
    return Vec(r * r * (1 + 2 * s) * y + s * s * (3 - 2 * s) * y_end + h * s * r * (r * slope - s * slope_end));
  };
  for (const double s : {0.25, 0.5, 0.75})
    if (event_functions(between(s)).minCoeff() < -tolerance) return true;
  return false;
}

// Finds the first event within h; its margin ends between 1 and 9 tolerances below 0. Returns its time. `y_end` is the
// state after h on entry, and the state at the event on return. By the Illinois method for each function of its own, as
// the least of all functions is often 0 at the start, where another one begins at 0 and grows. Where that is slow, by
// bisection.
double SpringImpact::locate(const Vec& y, double h, Vec& y_end) {
  const double aim = 5 * tolerance, within = 4 * tolerance;
  Vec inside, at_lo = event_functions(y).cwiseMax(0).array() + aim, at_hi = event_functions(y_end).array() + aim;
  double lo = 0, hi = h, off = at_hi.minCoeff(), wide = h;
  for (int i = 0, side = 0; i < most_trials && off < -within && hi - lo > narrowest * h; ++i) {
    const bool slow = i % 3 == 2 && hi - lo > wide / 2;
    double middle = slow ? lo : first_zero(lo, at_lo, hi, at_hi);
    if (!(middle > lo && middle < hi)) middle = 0.5 * (lo + hi);
    if (i % 3 == 2) wide = hi - lo;
    extrapolate(y, middle, inside);
    ++trials_;
    const Vec at = event_functions(inside).array() + aim;
    if (at.minCoeff() <= within) {
      hi = middle, off = at.minCoeff(), at_hi = at, y_end = inside;
      if (side < 0) at_lo /= 2;
      side = -1;
    } else {
      lo = middle, at_lo = at;
      if (side > 0) at_hi /= 2;
      side = 1;
    }
  }
  return hi;
}

bool SpringImpact::advance_to_event() {
  Vec y = state(), y_end;
  double gone = 0;
  for (int step = 0; step < most_steps; ++step) {
    const double error = extrapolate(y, h_, y_end);
    const double factor = std::clamp(0.9 * std::pow(std::max(error, least_error), -1.0 / (order - 1)), 0.2, 3.0);
    if (!(error <= 1) && h_ > shortest) {
      h_ *= std::isfinite(error) ? factor : 0.2;
      continue;
    }
    if (event_functions(y_end).minCoeff() < -tolerance) {
      gone += locate(y, h_, y_end);
      ++events_;
      take(y_end);
      standing_ = gone > no_progress ? 0 : standing_ + 1;
      return standing_ <= 50 + 10 * n_;
    }
    if (h_ > may_hide && dips_within(y, h_, y_end)) {
      h_ /= 2;
      continue;
    }
    y = y_end;
    take(y);
    gone += h_;
    h_ = std::min(h_ * factor, longest);
    if (gone > endless || finished() || wedged()) return gone <= endless;
  }
  return false;
}

Vec SpringImpact::event_functions(const Vec& y) {
  all_margins(y, margins_);
  Vec values(3 * n_);
  for (Eigen::Index i = 0; i < n_; ++i) {
    const Margins& m = margins_[std::size_t(i)];
    values.segment<3>(3 * i) << m.spring, m.rate, m.tangent;
  }
  return values;
}

void SpringImpact::all_margins(const Vec& y, std::vector<Margins>& margins) {
  derivative(y, dy_);
  margins.assign(contacts_.size(), {});
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    const double x = y[Eigen::Index(i)] / v_, rate = u_[c.normal] / v_;
    margins[i].rate = c.presses && c.compresses ? -rate : rate;
    if (c.presses && !c.compresses) margins[i].spring = x;
    if (!c.presses || c.mode == Tangent::none) continue;
    if (c.mode == Tangent::sticks) {
      margins[i].tangent = (c.mu_0 * f_[c.normal] - f_.segment(c.tangent, t_).norm()) / (k_ * v_);
    } else {
      const Slip s = slip(c, u_);
      const bool turns = t_ == 2 && c.slid;
      margins[i].tangent = (turns ? s.norm() - slow_ : s.dot(c.direction.head(t_)) + (c.slid ? 0 : 2 * slow_)) / v_;
    }
  }
  if (!dependent_) return;
  // Friction forces of dependent contacts are not unique. Whether others hold is asked only where no other function
  // says that an event has passed.
  const auto too_large = [](const Contact& c, const Margins& m) {
    return c.presses && c.mode == Tangent::sticks && m.tangent < -tolerance;
  };
  bool any = false;
  double others = no_event;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const bool asks = too_large(contacts_[i], margins[i]);
    any = any || asks;
    others = std::min({others, margins[i].normal(), asks ? no_event : margins[i].tangent});
  }
  if (!any || (others >= -passed * tolerance && !some_forces_hold(f_))) return;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (contacts_[i].mode == Tangent::sticks && margins[i].tangent < 0) margins[i].tangent = no_event;
}

}  // namespace trammel::simulate
