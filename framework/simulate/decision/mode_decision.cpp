#include "simulate/decision/mode_decision.hpp"

#include <algorithm>

#include "simulate/verdicts/errors_of_solutions.hpp"
#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;
using Friction = model::ContactMode::Friction;

namespace {

// Relative to the largest force in the island: what is left, or lacks, of a force at the instant found for its end.
constexpr double error_of_release = 1e-10;
// Of the accelerations. A contact that has just opened departs as slowly as its force passed 0, up to the round-off of
// forces.
constexpr double opened_by_error = 1e-6;
// Of `no_acceleration`, which is their round-off: the accelerations of the scene.
constexpr double over_round_off = 1e12;

}  // namespace

complementarity::ContactSolution ModeDecision::decide(State& state, const ContactChanges& changes, bool jumped) {
  if (changes.locked) return {LcpOutcome::no_solution, 0};
  auto solution = instant_.decide(state, changes, jumped);
  if (solution.outcome == LcpOutcome::solved) solution = open_freed(state, changes, jumped, solution);
  if (solution.outcome == LcpOutcome::solved && changes_sign_by_infinity(state, changes)) {
    ContactChanges others = changes;
    others.released.clear();
    solution = instant_.decide(state, others, jumped);
  }
  if (solution.outcome == LcpOutcome::no_solution) return solution;
  std::vector<bool> asked(at_.modes.contacts.size(), solution.outcome == LcpOutcome::gave_up);
  if (solution.outcome == LcpOutcome::solved) {
    const std::vector<bool> open = in_doubt(changes.released);
    if (std::find(open.begin(), open.end(), true) == open.end()) return solution;
    for (std::size_t i = 0; i < open.size(); ++i) asked[std::size_t(instant_.problem().who[i].contact)] = open[i];
  }
  return what_follows_.decide(state, changes, jumped, asked, solution);
}

// Rule 13. Where a row follows from others no more: of several solutions, the one in which a contact that shared opens
// and parts with the largest acceleration.
complementarity::ContactSolution ModeDecision::open_freed(State& state, const ContactChanges& changes, bool jumped,
                                                          const complementarity::ContactSolution& so_far) {
  if (!changes.leaning || implied_rows(at_.modes) >= implied_rows(at_.before)) return so_far;
  const std::vector<int> all = instant_.candidates();
  const model::Modes found = at_.modes;
  const auto decide_without = [&](int contact) { return instant_.decide(state, changes, jumped, {}, contact); };
  int freed = -1;
  double fastest = 0;
  for (const int contact : all) {
    if (!at_.shared_before[std::size_t(contact)] || !found.contacts[contact].closed || scene_.locks(contact)) continue;
    if (decide_without(contact).outcome != LcpOutcome::solved || !instant_.forces().exist(state)) continue;
    const double apart = scene_.system.acceleration({contact, 0}, instant_.forces().a());
    if (apart > std::max(fastest, instant_.least_acceleration(contact))) fastest = apart, freed = contact;
  }
  return decide_without(freed);
}

// The force of a sliding contact may change its sign through infinity (Painleve's critical state): without the force
// the contact would then approach. A force that passes 0 leaves an acceleration that passes 0 too: its sign is
// round-off.
bool ModeDecision::changes_sign_by_infinity(const State& state, const ContactChanges& changes) const {
  const std::vector<int>& released = changes.released;
  const bool slides = std::any_of(instant_.problem().who.begin(), instant_.problem().who.end(),
                                  [](const Participant& p) { return p.tangent == Participant::Tangent::sliding; }) ||
                      std::any_of(released.begin(), released.end(), [this](int contact) {
                        return at_.before.contacts[contact].friction == Friction::slide;
                      });
  if (released.empty() || !slides) return false;
  scene_.system.set_modes(at_.modes);
  scene_.system.move_to(state.t, state.q, state.v);
  Vec a, lambda;
  scene_.system.accelerate({}, a, lambda);
  return std::any_of(released.begin(), released.end(), [&](int contact) {
    const double of_scene = over_round_off * scene_.scale.of(contact).no_acceleration();
    return !at_.modes.contacts[contact].closed &&
           scene_.system.acceleration({contact, 0}, a) <
               -opened_by_error * std::max(at_.largest[std::size_t(contact)], of_scene);
  });
}

// Rule 11. By participant: in its island the error of the solution, or of the instant at which a force fell to 0,
// leaves open which contacts press. What is left of that force may have passed to another contact.
std::vector<bool> ModeDecision::in_doubt(const std::vector<int>& released) const {
  if (instant_.problem().who.empty()) return {};
  const auto loses_a_force = [&](int contact) {
    return std::any_of(released.begin(), released.end(),
                       [&](int other) { return scene_.scale.island(other) == scene_.scale.island(contact); });
  };
  const std::vector<double> largest = instant_.problem().largest_in_island();
  const std::vector<std::size_t> island = instant_.problem().islands();
  std::vector<bool> open(instant_.problem().who.size(), false), all;  // by island
  for (std::size_t i = 0; i < instant_.problem().who.size(); ++i) {
    const Participant& p = instant_.problem().who[i];
    const bool opens = at_.before.contacts[p.contact].closed && !at_.modes.contacts[p.contact].closed;
    const double error = loses_a_force(p.contact) ? std::max(p.violation, error_of_release) : p.violation;
    const bool just_presses =
        p.N > 0 && (p.N <= undecided * error * largest[i] || instant_.verdicts().would_hardly_close(i));
    if (p.unilateral && (just_presses || (opens && p.a_n <= instant_.verdicts().least_acceleration(p))))
      open[island[i]] = true;
  }
  for (const std::size_t k : island) all.push_back(open[k]);
  return all;
}

}  // namespace trammel::simulate
