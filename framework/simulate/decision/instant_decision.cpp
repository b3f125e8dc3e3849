#include "simulate/decision/instant_decision.hpp"

#include "simulate/decision/drift.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

void InstantDecision::gather(const Occasion& now, int without) {
  candidates_ = participants_.candidates(now.changes);
  std::erase(candidates_, without);
  problem_.who = participants_.gather(candidates_, now);
}

complementarity::ContactSolution InstantDecision::decide(State& state, ContactChanges changes, bool jumped,
                                                         const std::vector<Participant>& nearby, int without) {
  bearings_.restart();
  by_forces_.restart();
  at_.largest.assign(at_.modes.contacts.size(), 0);
  Drift drift(scene_, at_, participants_, problem_);
  do {
    gather({state, changes, jumped}, without);
    participants_.open_all(at_.modes);
    if (problem_.who.empty()) return {LcpOutcome::solved, 0};
    problem_.prepare(scene_.system);
  } while (drift.stop_with_others(changes) || drift.end_drift(state, changes, jumped));
  for (std::vector<Participant> begin = nearby;;) {
    scene_.system.set_modes(at_.modes);
    scene_.system.move_to(state.t, state.q, state.v);
    participants_.accelerate(problem_);
    if (bearings_.any_bearings()) return bearings_.decide(state);
    const complementarity::ContactSolution solution = by_forces_.solve(state, begin);
    if (solution.outcome != LcpOutcome::solved) return solution;
    if (by_forces_.share_within_bounds(state)) return solution;
    if (by_forces_.bounded_by_springs()) begin = problem_.who;
    participants_.open_all(at_.modes);
  }
}

}  // namespace trammel::simulate
