// The state at a part theta of a step, between two states of a solution: the cubic through v and a of both ends (Hermite), and
// the one through q and v, on the manifold of configurations; or, of an integrator whose steps are not like that
// (oscillating_steps.hpp), its own where it finds one.
#pragma once

#include <limits>

#include <trammel/methods/oscillating_steps.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class BetweenStates {
 public:
  BetweenStates(model::AssembledSystem& system, Integrator& integrator)
      : system_(system), own_(dynamic_cast<OscillatingSteps*>(&integrator)) {}

  OscillatingSteps* oscillating() { return own_; }  // none: steps are smooth
  bool swings() const { return own_ != nullptr; }
  // [s] of steps that are as smooth as the cubic through their ends supposes.
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
