// The state at theta in [0, 1] between the two ends of a step: cubic Hermite polynomials through v and a, and through q
// and v on the manifold of configurations. For an integrator with OscillatingSteps it is the integrator's dense output,
// if it finds a state.
#pragma once

#include <limits>

#include <trammel/methods/oscillating_steps.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class BetweenStates {
 public:
  BetweenStates(model::AssembledSystem& system, Integrator& integrator)
      : system_(system), own_(dynamic_cast<OscillatingSteps*>(&integrator)) {}

  OscillatingSteps* oscillating() { return own_; }  // null: steps are smooth
  bool swings() const { return own_ != nullptr; }
  // [s] largest size of a step for which the cubic polynomial is adequate.
  double longest_resolved() const {
    constexpr double radians = 2;
    const double swing = own_ ? own_->swing() : 0;
    return swing > 0 ? radians / swing : std::numeric_limits<double>::infinity();
  }
  // Fills t, q, v.
  void at(const State& now, const State& next, double theta, State& between) {
    if (own_) own_->interpolate(system_, now, next, theta, between);
    if (!own_ || !between.q.allFinite() || !between.v.allFinite()) cubic(now, next, theta, between);
    between.t = now.t + theta * (next.t - now.t);
  }

 private:
  void cubic(const State& now, const State& next, double theta, State& between) {
    const double h = next.t - now.t, x = theta, y = 1 - theta;
    const double end = x * x * (3 - 2 * x), begin_slope = h * x * y * y, end_slope = -h * x * x * y;
    system_.difference(next.q, now.q, dq_);
    dq_ = end * dq_ + begin_slope * now.v + end_slope * next.v;
    system_.retract(now.q, dq_, between.q);
    between.v = (1 - end) * now.v + end * next.v + begin_slope * now.a + end_slope * next.a;
  }

  model::AssembledSystem& system_;
  OscillatingSteps* own_;
  Vec dq_;
};

}  // namespace trammel::simulate
