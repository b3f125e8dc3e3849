#include <cmath>
#include <utility>

#include <trammel/methods/error_along_rows.hpp>

namespace trammel {

void ErrorAlongRows::project(System& s, const State& at, Vec& e_v) {
  if (s.sizes().nc == 0) return;
  zero_.setZero(s.sizes().nv);
  no_force_.setZero(s.sizes().nc);
  s.move_to(at.t, at.q, at.v);
  s.factorise({1, 0, 0}, zero_, no_force_, Factors::projection);
  project(s, e_v);
}

void ErrorAlongRows::project(System& s, Vec& e_v) {
  zero_.setZero(s.sizes().nv);
  right_.setZero(s.sizes().nc);
  s.add_rows_times(1, e_v, right_);
  if (s.correct(zero_, right_, change_, mu_, Factors::projection)) e_v += change_;
}

bool ErrorAlongRows::falls(const State& now, const State& next, double error) {
  constexpr double slowest = 2;  // order
  const Trial before = std::exchange(trial_, {now.t, next.t - now.t, error});
  const double shorter = trial_.h / before.h;
  return before.t != now.t || !(shorter < 1) || error < std::pow(shorter, slowest) * before.error;
}

}  // namespace trammel
