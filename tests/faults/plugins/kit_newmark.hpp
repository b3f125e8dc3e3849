// Newmark's method with an error estimate and dense output, and the same with one fault each.
#pragma once

#include <cmath>

#include <trammel/methods/newmark_error.hpp>
#include <trammel/methods/newmark_step.hpp>
#include <trammel/parameters.hpp>

namespace kit_faults {

using namespace trammel;

enum class NewmarkFault {
  none,
  estimate_ten_times_too_large,
  estimate_ten_times_too_small,
  estimate_of_another_order,
  inside_is_the_start,
  inside_misses_the_end,
  inside_is_of_the_last_trial,
  wrong_damping_is_accepted,
};

template <NewmarkFault fault>
class Newmark final : public Integrator, public ErrorEstimate, public DenseOutput {
 public:
  double gamma = 0.5;

  void prepare(const World&) override { error_.set(0, 0, 0.25, gamma); }
  Traits traits() const override {
    return {.order = gamma == 0.5 ? 2 : 1, .implicit = true, .holds_position = true, .holds_velocity = true};
  }
  void restart(System&, const State& now) override { error_.restart(now); }
  Outcome step(System& s, const State& now, double h, State& next) override {
    step_.dq = h * now.v + h * h * 0.25 * now.a;
    step_.v = now.v + h * (1 - gamma) * now.a;
    step_.begin(s, now, h, 0.25 * h * h, gamma * h, next);
    while (step_.iterating()) {
      step_.move(s, now, next);
      r_ = -s.f();
      s.add_reaction(1, next.lambda, r_);
      s.add_mass_times(1, next.a, r_);
      step_.correct(s, {1, gamma * h, 0.25 * h * h}, r_, next);
    }
    h_ = h;
    const Outcome outcome = step_.finish(s, now, next);
    // A square root of a negative number at values that the range allows.
    if (fault == NewmarkFault::wrong_damping_is_accepted) next.v *= std::sqrt(0.9 - gamma) / std::sqrt(0.9 - gamma);
    return outcome;
  }
  void accept(System&, const State&, const State& next) override { error_.accept(next); }
  void archive(Archive& a) override { error_.archive(a); }

  double error(System& s, const State& now, const State& next, const Tolerance& t) override {
    const double e = error_(s, now, next, t);
    if (fault == NewmarkFault::estimate_ten_times_too_large) return 10 * e;
    if (fault == NewmarkFault::estimate_ten_times_too_small) return e / 10;
    return fault == NewmarkFault::estimate_of_another_order ? e / (20 * (next.t - now.t)) : e;
  }
  int error_order() const override { return error_.order(); }

  // Hermite's cubic polynomial.
  void interpolate(System&, const State& now, const State& next, double x, State& at) override {
    const double h = fault == NewmarkFault::inside_is_of_the_last_trial ? h_ : next.t - now.t;
    at.t = now.t + x * (next.t - now.t);
    if (fault == NewmarkFault::inside_is_the_start) {
      at.q = now.q, at.v = now.v;
      return;
    }
    const double end = fault == NewmarkFault::inside_misses_the_end ? 1e-6 : 0;
    const Vec jump = next.q - now.q, mean = jump / h;
    at.q = now.q + x * jump + x * (1 - x) * h * ((1 - x) * (now.v - mean) - x * (next.v - mean));
    at.v = (1 - x) * now.v + x * next.v + x * (1 - x) * 3 * (2 * mean - now.v - next.v);
    at.q.array() += end * x;
  }

 private:
  NewmarkStep step_;
  NewmarkError error_;
  double h_ = 0;
  Vec r_;
};

template <NewmarkFault fault>
Declaration newmark(const char* name) {
  return integrator<Newmark<fault>>(name, "Newmark's method")
      .source("Newmark 1959, J. Eng. Mech. Div. ASCE 85(3), 67-94")
      .parameter("gamma", &Newmark<fault>::gamma, {.min = 0.5, .max = 1, .doc = "above 1/2 damps"});
}

}  // namespace kit_faults
