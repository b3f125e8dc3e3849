#include <algorithm>
#include <cmath>
#include <limits>

#include <trammel/methods/error_norm.hpp>
#include <trammel/methods/runge_kutta.hpp>

namespace trammel {

namespace {

// Largest violation of the rows where a slope may be evaluated [m, rad; relative to the speed], inside a step and at
// its end. Near a change of rank the error of the accelerations is this violation divided by the square of the angle
// between rows. Rows are independent down to an angle of 1e-7.
constexpr double round_off = 1e-15;
// Rows are differences of coordinates, whose round-off is this share of the largest place. Slow convergence at a
// smaller violation counts as round-off; with new factors it also does so below `stalling` [m, rad].
constexpr double round_off_of_place = 1e-14, stalling = 1e-9;
// A projection that leaves a larger violation has failed: [m, rad], and relative to the largest place.
constexpr double most_left = 1e-6, most_left_of_place = 1e-13;

// Numbers of this square are far beyond the range of any model, and small enough that a model may form fourth powers.
constexpr double largest_square = 1e120;

bool within_range(const Vec& x) {
  return x.squaredNorm() < largest_square;  // false for NaN, too
}

}  // namespace

RungeKutta::RungeKutta(const Tableau& tableau) : tableau_(tableau), k_(std::size_t(tableau.stages) + 1) {}

bool RungeKutta::evaluate(System& s, double t, const Vec& q, const Vec& v, Slope& slope) {
  if (!within_range(q) || !within_range(v)) return false;
  on_manifold_ = q;
  s.normalise(on_manifold_);
  held_v_ = v;
  if (projects() && s.sizes().nc > 0 && !onto_rows(s, t)) return false;
  s.rate(on_manifold_, held_v_, slope.q);
  s.move_to(t, on_manifold_, held_v_);
  s.accelerate(baumgarte, slope.v, slope.lambda);
  return within_range(slope.q) && within_range(slope.v) && within_range(slope.lambda);
}

void RungeKutta::begin(System& s, const State& now, Slope& slope) {
  forget();
  kept_ = false;
  if (!evaluate(s, now.t, now.q, now.v, slope)) slope = {};
}

// Projection of on_manifold_ and held_v_ onto the rows by a modified Newton iteration. `projected`: the first factors
// have an error of the order of the violation; the second ones, near the solution, are used until the end. With the
// factors of the step's start each iteration reduces the violation by a factor of order h; the projection fails if it
// converges too slowly.
class RungeKutta::OntoRows {
 public:
  OntoRows(RungeKutta& method, System& s, double t) : m_(method), s_(s), t_(t) {
    const double of_place = m_.on_manifold_.lpNorm<Eigen::Infinity>();
    near_round_off_ =
        m_.kept_ ? round_off_of_place * std::max(1.0, of_place) : std::max(stalling, round_off_of_place * of_place);
    lost_ = std::max(most_left, most_left_of_place * of_place);
  }

  static void factorise(RungeKutta& m, System& s) {
    m.zero_.setZero(s.sizes().nv);
    m.no_force_.setZero(s.sizes().nc);
    s.factorise({1, 0, 0}, m.zero_, m.no_force_, Factors::projection);
  }

  [[nodiscard]] bool move_position() {
    for (int i = 0; i < most_iterations; ++i) {
      s_.move_to(t_, m_.on_manifold_, m_.held_v_);
      if (!remains(i, s_.g(), 1)) break;
      if (!solve(i, violation_, 1)) return false;
      s_.retract(m_.on_manifold_, m_.change_, m_.q_);
      m_.on_manifold_.swap(m_.q_);
    }
    return violation_ <= lost_;
  }

  [[nodiscard]] bool move_velocity() {
    const double off = violation_, speed = std::max(1.0, m_.held_v_.lpNorm<Eigen::Infinity>());
    for (int i = 0; i < most_iterations; ++i) {
      s_.move_to(t_, m_.on_manifold_, m_.held_v_);
      if (!remains(i, s_.g_dot(), speed)) break;
      if (!solve(i, off, speed)) return false;
      m_.held_v_ += m_.change_;
    }
    return true;
  }

 private:
  static constexpr int most_iterations = 20;

  // False: converged, or at round-off.
  bool remains(int i, const Vec& off, double size) {
    m_.right_ = off;
    before_ = violation_;
    violation_ = m_.right_.lpNorm<Eigen::Infinity>();
    const bool stalls = i > 0 && violation_ > 0.5 * before_ && violation_ < near_round_off_ * size;
    return violation_ > round_off * size && !stalls;
  }

  bool shrinks_less_than(double factor, int i, double size) const {
    return i > 0 && violation_ > factor * before_ && violation_ > near_round_off_ * size;
  }

  // `off`: the violation of the positions.
  [[nodiscard]] bool solve(int i, double off, double size) {
    constexpr double in_place = 1e-3, well = 0.1, reach = 0.25;
    if (m_.kept_) {
      if (shrinks_less_than(reach, i, size)) return false;
    } else if (off < factorised_at_ && (factorised_at_ > in_place || shrinks_less_than(well, i, size))) {
      factorise(m_, s_);
      factorised_at_ = off;
    }
    return s_.correct(m_.zero_, m_.right_, m_.change_, m_.mu_, Factors::projection);
  }

  RungeKutta& m_;
  System& s_;
  double t_;
  double near_round_off_, lost_;  // [m, rad]
  double factorised_at_ = std::numeric_limits<double>::infinity(), before_ = 0, violation_ = 0;
};

bool RungeKutta::keep_null_space(System& s, const State& now) {
  kept_ = rows == Rows::null_space && s.sizes().nc > 0;
  if (!kept_) return false;
  s.move_to(now.t, now.q, now.v);
  OntoRows::factorise(*this, s);
  return true;
}

bool RungeKutta::onto_rows(System& s, double t) {
  OntoRows newton(*this, s, t);
  return newton.move_position() && newton.move_velocity() && within_range(on_manifold_) && within_range(held_v_);
}

void RungeKutta::combine(const double* weights, int n, Vec& dq, Vec& dv) const {
  dq = h_ * weights[0] * k_[0].q;
  dv = h_ * weights[0] * k_[0].v;
  for (int i = 1; i < n; ++i) {
    if (weights[i] == 0) continue;
    dq += h_ * weights[i] * k_[std::size_t(i)].q;
    dv += h_ * weights[i] * k_[std::size_t(i)].v;
  }
}

double RungeKutta::norm(System& s, const State& now, const State& next, const Vec& e, Vec& e_v, Part part,
                        const Tolerance& tolerance) {
  if (part == Part::along_rows) along_rows_.project(s, next, e_v);
  error_increment(s, next.q, e, embedded_, e_q_);
  return error_norm(e_q_, e_v, now, next, tolerance);
}

Outcome RungeKutta::step(System& s, const State& now, const Slope& first, double h, State& next) {
  filled_ = 0;
  if (first.v.size() != now.v.size()) return Outcome::reject(out_of_range);
  k_[0] = first;
  return within_step(s, now, [&] { return all_stages(s, now, h, next); });
}

Outcome RungeKutta::all_stages(System& s, const State& now, double h, State& next) {
  const int stages = tableau_.stages;
  filled_ = 1;
  h_ = h;
  for (const double* row = tableau_.a; filled_ < stages; row += filled_ - 1)
    if (!add_stage(s, now, tableau_.c[filled_], row)) return Outcome::reject(diverged);

  combine(tableau_.b, stages, dq_, dv_);
  next.t = now.t + h;
  next.q = now.q + dq_;
  next.v = now.v + dv_;
  return end(s, next);
}

Outcome RungeKutta::end(System& s, State& next) {
  if (!within_range(next.q) || !within_range(next.v)) return Outcome::reject(diverged);
  s.normalise(next.q);
  Slope& slope = k_[std::size_t(filled_)];
  if (!evaluate(s, next.t, next.q, next.v, slope)) return Outcome::reject(diverged);
  ++filled_;
  if (projects()) taken_at(next.q, next.v);
  next.a = slope.v;
  next.lambda = slope.lambda;
  return Outcome::accept();
}

bool RungeKutta::add_stage(System& s, const State& now, double c, const double* row) {
  combine(row, filled_, dq_, dv_);
  q_ = now.q + dq_;
  v_ = now.v + dv_;
  if (k_.size() == std::size_t(filled_)) k_.emplace_back();
  // Other code may have replaced the factors since the step.
  const bool later = by_null_space_ && filled_ > tableau_.stages;
  if (later && !keep_null_space(s, now)) return false;
  const bool known = evaluate(s, now.t + c * h_, q_, v_, k_[std::size_t(filled_)]);
  if (later) kept_ = false;
  if (known) ++filled_;
  return known;
}

bool RungeKutta::recall(System& s, const State& now, const State& next) {
  // Compare the step size, up to round-off of t, and the final acceleration: one alone may agree with that of another
  // step.
  const double h = next.t - now.t;
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(now.t), std::abs(next.t));
  const Vec& a = k_[std::size_t(tableau_.stages)].v;
  if (filled_ > tableau_.stages && std::abs(h - h_) <= rounding && a.size() == next.a.size() && a == next.a)
    return true;
  const Slope first = k_[0];
  return step(s, now, first, h, repeated_).accepted();
}

void RungeKutta::interpolate(const System& s, const State& now, const State& next, double theta,
                             std::initializer_list<const double*> terms, State& at) {
  const Slope& first = k_[0];
  const Slope& last = k_[std::size_t(tableau_.stages)];
  // Hairer's nested form, from the inside out: y_0 + theta (F_0 + (1 - theta) (F_1 + theta (F_2 + (1 - theta) (F_3 +
  // ...)))).
  at.q.setZero(now.q.size());
  at.v.setZero(now.v.size());
  int level = 2 + int(terms.size());
  for (const double* const* row = terms.end(); row != terms.begin(); --level) {
    combine(*--row, filled_, dq_, dv_);
    const double weight = level % 2 ? 1 - theta : theta;
    at.q = weight * (dq_ + at.q);
    at.v = weight * (dv_ + at.v);
  }
  dq_ = next.q - now.q;
  dv_ = next.v - now.v;
  at.q = theta * (2 * dq_ - h_ * (first.q + last.q) + at.q);
  at.v = theta * (2 * dv_ - h_ * (first.v + last.v) + at.v);
  at.q = (1 - theta) * (h_ * first.q - dq_ + at.q);
  at.v = (1 - theta) * (h_ * first.v - dv_ + at.v);
  at.q = now.q + theta * (dq_ + at.q);
  at.v = now.v + theta * (dv_ + at.v);
  at.t = now.t + theta * h_;
  s.normalise(at.q);
}

void RungeKutta::step_inside(System& s, const State& now, const State& next, double theta, State& at) {
  const Slope first = k_[0];
  const double h = theta * (next.t - now.t);
  if (step(s, now, first, h, at)) return;
  at = now;
  at.t += h;
  at.q.setConstant(std::numeric_limits<double>::quiet_NaN());
  at.v.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void error_increment(const System& s, const Vec& q, const Vec& e, Vec& embedded, Vec& increment) {
  embedded = q - e;
  s.normalise(embedded);
  s.difference(q, embedded, increment);
}

}  // namespace trammel
