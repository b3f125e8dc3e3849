// How a run fails: at which step, for which reason, and which component is to blame.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "run/run_failed.hpp"
#include "simulate/event/trial_step.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/blame.hpp"

namespace trammel::simulate {

std::string Simulator::circumstances() {
  for (const ContactEvent& event : events_) last_motions_.take(event);  // found, but not written yet
  try {
    return last_motions_.say(system_, {now_, next_, tried_, error_parts_, iterated_}, settings_.until);
  } catch (const std::exception&) {
    return "";  // a component has no answer at the state
  }
}

std::string Simulator::here() const {
  return fmt::format("at t = {:.9g} s, step {}", now_.t, statistics_.steps);
}

std::string Simulator::when(double h) const {
  return fmt::format("at t = {:.9g} s, step {} of {:.3g} s", now_.t, statistics_.steps + 1, h);
}

void Simulator::fail(double h, const std::string& why) const {
  throw RunFailed(fmt::format("{}: {}", when(h), why));
}

void Simulator::fail_for_error(double h, Tolerance tolerance) {
  tolerance.parts = &error_parts_;
  estimate_->error(system_, now_, next_, tolerance);
  fail(h, fmt::format("the error cannot be kept below the tolerance with steps of at least {:.3g} s",
                      control().smallest(now_.t)));
}

bool Simulator::near_the_end_of_numbers() const {
  return !(std::max(now_.q.lpNorm<Eigen::Infinity>(), now_.v.lpNorm<Eigen::Infinity>()) < 1e30);
}

// Throws if a component returned numbers that are not finite where the step began, or at the times of its trials. Does
// not throw if the state itself is near the end of the number range: there any component may overflow.
void Simulator::find_culprit(double h) {
  if (near_the_end_of_numbers()) return;
  for (const double part : {0.0, 0.5, 1.0, 2.0}) {
    system_.move_to(now_.t + part * h, now_.q, now_.v);
    const model::CallSite site = system_.find_not_finite();
    if (site.origin) throw NotFinite(when(h), site);
  }
}

// The components return finite numbers and the step does not: the method is to blame if no shorter step helps.
void Simulator::fail_not_finite(double h) {
  find_culprit(h);
  const std::string what = not_finite_in(next_);
  if (!what.empty() && !near_the_end_of_numbers() && !finite_with_shorter_steps(integrator_, system_, now_, h, inside_))
    throw BadStep(fmt::format("it returned {}; expected finite numbers", what));
  fail(h, "the solution diverged: numbers that are not finite. The step may be too long for the method");
}

}  // namespace trammel::simulate
