#include "simulate/verdicts/modes_by_forces.hpp"

#include <algorithm>

#include "complementarity/exact_modes.hpp"
#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;
using Friction = model::ContactMode::Friction;

ModesByForces::ModesByForces(const ContactScene& scene, ContactsAtEvent& at, ContactProblem& problem)
    : at_(at),
      problem_(problem),
      forces_(scene, at, problem),
      verdicts_(scene, at, problem),
      idle_(scene, at, problem, forces_),
      bounds_(scene, at, problem, forces_),
      springs_(scene, at, problem, forces_) {}

complementarity::ContactSolution ModesByForces::solve(const State& state, const std::vector<Participant>& nearby) {
  const complementarity::ContactSolution solution = problem_.solve(nearby);
  if (solution.outcome != LcpOutcome::solved) return solution;
  verdicts_.take();
  idle_.find_shares(state);
  idle_.open_pulling_ones(state);
  return solution;
}

bool ModesByForces::share_within_bounds(const State& state) {
  const std::vector<Participant*> held = bounds_.find(state);
  if (springs_.bound_by_springs(state, held) || HeldAtBounds::let_go(held)) return false;
  for (Participant* p : held) bounds_.keep(*p);
  if (!held.empty()) idle_.find_shares(state);
  share_forces_found(state);
  return true;
}

// Rule 14. Islands which it does not help keep what was decided.
void ModesByForces::share_forces_found(const State& state) {
  if (std::none_of(at_.modes.shared.begin(), at_.modes.shared.end(), has_sliding)) return;
  std::vector<bool> asked = forces_.can_be_exerted(state);  // by island
  asked.flip();
  if (std::find(asked.begin(), asked.end(), true) == asked.end()) return;
  const model::Modes decided = at_.modes;
  const std::vector<Participant> found = problem_.who;
  verdicts_.take();
  const std::vector<bool> at_edge = problem_.take_fewest_forces(at_.modes, asked);
  for (std::size_t i = 0; i < at_edge.size(); ++i)
    if (Participant& p = problem_.who[i]; at_edge[i] && at_.modes.contacts[p.contact].friction != Friction::slide)
      bounds_.keep(p);
  idle_.share(std::vector<double>(problem_.who.size(), complementarity::largest_violation));
  const std::vector<bool> exerted = forces_.can_be_exerted(state);
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> helped(at_.modes.contacts.size(), false);  // by contact
  for (std::size_t i = 0; i < found.size(); ++i) {
    helped[std::size_t(found[i].contact)] = asked[island[i]] && exerted[island[i]];
    if (!helped[std::size_t(found[i].contact)]) problem_.who[i] = found[i];
  }
  keep_others(decided, helped, at_.modes);
}

}  // namespace trammel::simulate
