// What a run does about joints that contradict each other or have come apart.
#include <algorithm>

#include <fmt/format.h>

#include "run/run_failed.hpp"
#include "simulate/simulator.hpp"

namespace trammel::simulate {

void Simulator::measure_joints() {
  system_.move_to(now_.t, now_.q, now_.v);
  open_joints_.measure(system_, scale_.scene().length(), scale_.scene().one_point());
}

void Simulator::judge_joints(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  if (const std::string open = open_joints_.description(system_, state); !open.empty())
    throw RunFailed(fmt::format(
        "at t = {:.9g} s, step {}: joints have come apart: {}. Shorter steps, \"corrections\" or a method that ends "
        "its steps on the rows keep them closed if they can be",
        state.t, statistics_.steps, open));
}

// Rows that begin to contradict each other give accelerations of least squares, which an explicit method would follow.
// Their violation exceeds Baumgarte's terms. Such rows are then examined, at the end of the step, where the system is.
bool Simulator::contradictory(const ConstraintNorms& norms) {
  constexpr double suspicious = 0.01;
  if (!(norms.acceleration > suspicious * std::max(1.0, next_.a.lpNorm<Eigen::Infinity>())) || !system_.redundant())
    return false;
  const bool found = !smallest_conflict(system_, next_).empty();
  system_.move_to(next_.t, next_.q, next_.v);
  return found;
}

Conflict Simulator::conflict() {
  if (system_.sizes().nc == 0 || near_the_end_of_numbers()) return {};
  system_.move_to(now_.t, now_.q, now_.v);
  if (!(system_.g().lpNorm<Eigen::Infinity>() < 1e3 * scale_.scene().length())) return {};  // diverged
  const double step = statistics_.largest_step > 0 ? statistics_.largest_step : settings_.every;
  for (const double ahead : {0.0, step}) {
    State s = now_;
    s.t += ahead;
    if (Conflict found = smallest_conflict(system_, s); !found.empty()) return found;
  }
  return {};
}

}  // namespace trammel::simulate
