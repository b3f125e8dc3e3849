#include <algorithm>
#include <cmath>

#include <trammel/methods/error_norm.hpp>
#include <trammel/methods/newmark_error.hpp>

namespace trammel {

namespace {

constexpr double of_second_order = 1e-14;  // gamma - 1/2 + alpha_m - alpha_f of such a method: round-off of the sum

}  // namespace

void NewmarkError::set(double alpha_m, double alpha_f, double beta, double gamma, bool of_velocities) {
  of_velocities_ = of_velocities;
  const double delta = alpha_m - alpha_f;
  const double share = (1 - alpha_f) / (1 - alpha_m);
  c_q_ = beta * share;
  c_v_ = gamma * share;
  first_ = gamma - 0.5 + delta;
  if (std::abs(first_) < of_second_order) first_ = 0;
  of_q_ = beta + delta / 2 - 1.0 / 6;
  of_v_ = (delta * (2 * alpha_m - 1) + gamma * (1 + 2 * delta) - 1.0 / 3) / 2;
}

void NewmarkError::restart(const State& now) {
  t_ = now.t;
  a_ = now.a;
  a_before_.resize(0);
  along_rows_.forget();
  // Scratch vectors that only some steps use.
  for (Vec* scratch : {&slow_q_, &slow_v_, &fast_, &momentum_}) scratch->resize(now.a.size());
  for (Vec* scratch : {&of_rows_, &mu_}) scratch->resize(now.lambda.size());
}

void NewmarkError::accept(const State& next) {
  h_before_ = next.t - t_;
  t_ = next.t;
  a_before_.swap(a_);
  a_ = next.a;
}

// a' there, from the previous step or by a difference.
void NewmarkError::find_rate(System& s, const State& now, double h) {
  if (has_step_before(now)) {
    rate_ = (now.a - a_before_) / h_before_;
    return;
  }
  const double ahead = h / 1000;
  e_q_ = ahead * now.v + ahead * ahead / 2 * now.a;
  s.retract(now.q, e_q_, q_);
  v_ = now.v + ahead * now.a;
  s.move_to(now.t + ahead, q_, v_);
  s.accelerate({}, rate_, lambda_);
  rate_ = (rate_ - now.a) / ahead;
}

double NewmarkError::operator()(System& s, const State& now, const State& next, const Tolerance& tolerance) {
  const double h = next.t - now.t;
  if (!of_velocities_) {
    e_q_ = of_q_ * h * h * (next.a - now.a);
    along_rows_.project(s, next, e_q_);
    e_v_.setZero(e_q_.size());
    return norm(s, now, next, e_v_, tolerance);
  }
  find_rate(s, now, h);
  const double steps = has_step_before(now) ? h + h_before_ : h;
  e_v_ = 2 * h * h / steps * ((next.a - now.a) / h - rate_);
  e_v_ = first_ * h * (next.a - now.a) + of_v_ * h * e_v_;
  e_q_ = of_q_ * h * h * (next.a - now.a);
  return along_rows_.judge(now, next, [&](ErrorAlongRows::Part part) {
    along_ = e_v_;
    if (part == ErrorAlongRows::Part::along_rows) along_rows_.project(s, next, along_);
    return norm(s, now, next, along_, tolerance);
  });
}

// The norm of e_q_ and e_v. Modes that are too fast for the step are filtered only if the whole error is too large.
double NewmarkError::norm(System& s, const State& now, const State& next, const Vec& e_v, const Tolerance& tolerance) {
  const double whole = error_norm(e_q_, e_v, now, next, tolerance);
  if (whole <= 1 || e_v.size() == 0) return whole;
  const double h = next.t - now.t;
  s.move_to(next.t, next.q, next.v);
  s.factorise({1, c_v_ * h, c_q_ * h * h}, next.a, next.lambda, Factors::projection);
  if (!filter(s, e_q_, slow_q_) || !filter(s, e_v, slow_v_)) return whole;
  fast_ = e_v - slow_v_;
  momentum_.setZero(fast_.size());
  s.add_mass_times(1, fast_, momentum_);
  const double all = fast_.dot(momentum_), slower = slow_v_.dot(momentum_);
  if (all > 0) slow_v_ += std::sqrt(std::clamp(slower / all, 0.0, 1.0)) * fast_;
  return std::min(whole, error_norm(slow_q_, slow_v_, now, next, tolerance));
}

bool NewmarkError::filter(System& s, const Vec& e, Vec& x) {
  momentum_.setZero(e.size());
  of_rows_.setZero(s.sizes().nc);
  s.add_mass_times(-1, e, momentum_);
  s.add_rows_times(-1, e, of_rows_);
  return s.correct(momentum_, of_rows_, x, mu_, Factors::projection);
}

void NewmarkError::archive(Archive& a) {
  a("error_t", t_);
  a("error_h_before", h_before_);
  a("error_a", a_);
  a("error_before_a", a_before_);
  along_rows_.archive(a);
}

}  // namespace trammel
