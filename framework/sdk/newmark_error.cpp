#include <cmath>

#include <trammel/methods/error_norm.hpp>
#include <trammel/methods/newmark_error.hpp>

namespace trammel {

void NewmarkError::set(double alpha_m, double alpha_f, double beta, double gamma, bool of_velocities) {
  of_velocities_ = of_velocities;
  const double delta = alpha_m - alpha_f;
  first_ = gamma - 0.5 + delta;
  if (std::abs(first_) < 1e-14) first_ = 0;  // round-off of a method of second order
  of_q_ = beta + delta / 2 - 1.0 / 6;
  of_v_ = (delta * (2 * alpha_m - 1) + gamma * (1 + 2 * delta) - 1.0 / 3) / 2;
}

void NewmarkError::restart(const State& now) {
  t_ = now.t;
  a_ = now.a;
  a_before_.resize(0);
  along_rows_.forget();
}

void NewmarkError::accept(const State& next) {
  h_before_ = next.t - t_;
  t_ = next.t;
  a_before_.swap(a_);
  a_ = next.a;
}

double NewmarkError::operator()(System& s, const State& now, const State& next, const Tolerance& tolerance) {
  const double h = next.t - now.t;
  e_q_ = of_q_ * h * h * (next.a - now.a);
  if (!of_velocities_) {
    along_rows_.project(s, next, e_q_);
    e_v_.setZero(e_q_.size());
    return error_norm(e_q_, e_v_, now, next, tolerance);
  }
  // rate_: a' at the step's start, from the previous step or by a difference.
  if (a_before_.size() == now.a.size() && h_before_ > 0) {
    rate_ = (now.a - a_before_) / h_before_;
    e_v_ = 2 * h * h / (h + h_before_) * ((next.a - now.a) / h - rate_);
  } else {
    const double ahead = h / 1000;
    e_q_ = ahead * now.v + ahead * ahead / 2 * now.a;
    s.retract(now.q, e_q_, q_);
    v_ = now.v + ahead * now.a;
    s.move_to(now.t + ahead, q_, v_);
    s.accelerate({}, rate_, lambda_);
    rate_ = (rate_ - now.a) / ahead;
    e_v_ = 2 * h * ((next.a - now.a) / h - rate_);
  }
  e_v_ = first_ * h * (next.a - now.a) + of_v_ * h * e_v_;
  e_q_ = of_q_ * h * h * (next.a - now.a);
  return along_rows_.judge(now, next, [&](ErrorAlongRows::Part part) {
    along_ = e_v_;
    if (part == ErrorAlongRows::Part::along_rows) along_rows_.project(s, next, along_);
    return error_norm(e_q_, along_, now, next, tolerance);
  });
}

void NewmarkError::archive(Archive& a) {
  a("error_t", t_);
  a("error_h_before", h_before_);
  a("error_a", a_);
  a("error_before_a", a_before_);
  along_rows_.archive(a);
}

}  // namespace trammel
