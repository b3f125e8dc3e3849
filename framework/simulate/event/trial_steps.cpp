#include "simulate/event/trial_steps.hpp"

#include "simulate/event/onsets.hpp"
#include "simulate/event/trial_step.hpp"

namespace trammel::simulate {

bool StepsFromNow::happened(const EventFunction& function, const ValueAndSlope& end) {
  if (!(end.f < 0)) return false;
  if (!function.just_handled() || end.f < std::min(function.now.f, 0.0) - function.noise) return true;
  return function.is_gap() && end.slope < -scale(function).left_by_impacts() &&
         !grazes(function.now, gap_acceleration(function), function.noise);
}

ValueAndSlope TrialSteps::at(EventFunction& function, double h) {
  if (h != h_) {
    ++count;
    h_ = 0;
    if (!trial_step(integrator_, system_, *now_, h, trial_)) throw StepRefused{};
    h_ = h;
  }
  values_.move_to(trial_);
  return values_.at(function, trial_);
}

double TrialSteps::force_slope(EventFunction& function, double dt) {
  return values_.force_slopes({&function}, trial_, dt).front();
}

double TrialSteps::gap_acceleration(const EventFunction& function) {
  return values_.gap_acceleration(function, *now_);
}

void TrialSteps::take(double h, State& next) {
  if (h == h_)
    next = trial_;
  else if (++count; !trial_step(integrator_, system_, *now_, h, next))
    throw StepRefused{};
}

}  // namespace trammel::simulate
