#include "simulate/settling/contact_impacts.hpp"

#include <algorithm>
#include <map>

#include "simulate/settling/rocking.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

void ContactImpacts::find_bearings() {
  at_.bearings.clear();
  for (int i = 0; i < int(scene_.system.model().contacts.size()); ++i)
    if (rubs_in_impacts(scene_.system.model().contacts[i])) at_.bearings.push_back({.contact = i, .was_closed = true});
}

void ContactImpacts::find_touching(const ContactChanges& changes) {
  at_.touching.clear();
  for (int i = 0; i < int(scene_.system.model().contacts.size()); ++i) {
    const Restitution* law = scene_.system.model().contacts[i].restitution;
    if (!law) continue;
    const bool closed = at_.before.contacts[i].closed, struck = contains(changes.struck, i);
    if (closed && scene_.locks(i)) continue;
    if (!closed && !struck && scene_.system.gap(i) > scene_.scale.of(i).touching()) continue;
    TouchingContact c;
    c.contact = i;
    c.was_closed = closed;
    c.before = c.after = scene_.system.gap_rate(i);
    if (struck && -c.before > scene_.capture_speed(i)) c.restitution = law->coefficient(-c.before);
    at_.touching.push_back(c);
  }
}

complementarity::ContactSolution ContactImpacts::strike(State& state, const ContactChanges& changes) {
  const double kinetic_before = scene_.system.energy().kinetic;
  v_before_ = state.v;
  BriefMotions brief;
  const auto solution = strike_with_captures(state, changes, brief);
  if (solution.outcome != LcpOutcome::solved) {
    state.v = v_before_;
    return solution;
  }
  const std::vector<TouchingContact> all = touching_and_bearings();  // with the rates that the impact left
  if (const std::size_t first = brief.first(); first < at_.touching.size()) {
    scene_.system.move_to(state.t, state.q, state.v);
    const double taken = Rocking(scene_, at_.touching).end(state, brief);
    losses_.push_back({at_.touching[first].contact, taken});  // of all of them, reported for the first
    lost_elsewhere_ -= taken;
  }
  scene_.system.move_to(state.t, state.q, state.v);
  lost_elsewhere_ += kinetic_before - scene_.system.energy().kinetic;
  for (const TouchingContact& c : all) {
    losses_.push_back({c.contact, c.energy_lost()});
    lost_elsewhere_ -= c.energy_lost();
  }
  warnings_.check(state.t, kinetic_before, rest_speed(all), all, cut_short_);
  return {LcpOutcome::solved, 0};
}

// Sets e = 0 for rebounds that are too short to follow; true if there are any.
bool ContactImpacts::capture_chatter(const std::vector<bool>& falls) {
  bool captured = false;
  for (std::size_t i = 0; i < at_.touching.size(); ++i)
    if (falls[i] && at_.touching[i].restitution > 0) at_.touching[i].restitution = 0, captured = true;
  return captured;
}

// Solves the impact from v_before_, again with e = 0 for rebounds that steps cannot follow, until there are none.
// `brief`: what is left that is too short to follow.
complementarity::ContactSolution ContactImpacts::strike_with_captures(State& state, const ContactChanges& changes,
                                                                      BriefMotions& brief) {
  for (;;) {
    std::vector<TouchingContact> all = touching_and_bearings();
    const auto solution = solve_impacts(state, all);
    if (solution.outcome != LcpOutcome::solved) return solution;
    std::copy_n(all.begin(), at_.touching.size(), at_.touching.begin());
    std::copy_n(all.begin() + std::ptrdiff_t(at_.touching.size()), at_.bearings.size(), at_.bearings.begin());
    state.v = v_before_ + dv_;
    brief = chatter_.too_brief(state, changes);
    if (!capture_chatter(brief.falls)) return solution;
    scene_.system.move_to(state.t, state.q, v_before_);
  }
}

std::vector<TouchingContact> ContactImpacts::touching_and_bearings() const {
  std::vector<TouchingContact> all = at_.touching;
  all.insert(all.end(), at_.bearings.begin(), at_.bearings.end());
  return all;
}

// Sets dv_ and, in `all`, the impulses and the rates after the impact. Bodies that nothing connects strike apart, each
// group by its own law. It is not known which group needs an impact without collision, so these are solved together.
complementarity::ContactSolution ContactImpacts::solve_impacts(const State& state, std::vector<TouchingContact>& all) {
  const bool together =
      std::any_of(all.begin(), all.end(), [](const TouchingContact& c) { return c.without_collision; });
  std::map<std::size_t, std::vector<std::size_t>> islands;
  for (std::size_t i = 0; i < all.size(); ++i) islands[together ? 0 : scene_.scale.island(all[i].contact)].push_back(i);
  dv_.setZero(scene_.system.sizes().nv);
  cut_short_ = false;
  std::size_t first = 0;  // index of the first island of this group
  Vec change;
  for (const auto& [number, members] : islands) {
    std::vector<TouchingContact> own;
    for (const std::size_t i : members) own.push_back(all[i]);
    const auto solution = laws_.solve(scene_.system, state, rest_speed(own), own, change);
    if (solution.outcome != LcpOutcome::solved) return solution;
    cut_short_ = cut_short_ || laws_.cut_short();
    dv_ += change;
    for (std::size_t k = 0; k < members.size(); ++k) {
      all[members[k]] = own[k];
      all[members[k]].island += first;
    }
    first += members.size();
  }
  return {LcpOutcome::solved, 0};
}

double ContactImpacts::rest_speed(const std::vector<TouchingContact>& contacts) const {
  double largest = 0;
  for (const TouchingContact& c : contacts) largest = std::max(largest, scene_.scale.of(c.contact).rest_speed());
  return largest;
}

}  // namespace trammel::simulate
