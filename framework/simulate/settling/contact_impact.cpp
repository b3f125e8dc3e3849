// Rules 1 and 9 of contact_mode.hpp: contacts that touch and close strike together, and latches among them lock.
#include <algorithm>
#include <map>

#include "simulate/settling/contact_mode.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

void ContactModes::find_touching(const ContactChanges& changes) {
  at_.touching.clear();
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) {
    const Restitution* law = system_.model().contacts[i].restitution;
    if (!law) continue;
    const bool closed = at_.before.contacts[i].closed, struck = contains(changes.struck, i);
    if (closed && scene_.locks(i)) continue;
    if (!closed && !struck && system_.gap(i) > scene_.scale.of(i).touching()) continue;
    TouchingContact c;
    c.contact = i;
    c.was_closed = closed;
    c.before = c.after = system_.gap_rate(i);
    if (struck && -c.before > scene_.capture_speed(i)) c.restitution = law->coefficient(-c.before);
    at_.touching.push_back(c);
  }
}

void ContactModes::find_bearings() {
  at_.bearings.clear();
  for (int i = 0; i < int(system_.model().contacts.size()); ++i)
    if (rubs_in_impacts(system_.model().contacts[i])) at_.bearings.push_back({.contact = i, .was_closed = true});
}

// Rules 1 and 2.
complementarity::ContactSolution ContactModes::strike(State& state, const ContactChanges& changes) {
  const double kinetic_before = system_.energy().kinetic;
  v_before_ = state.v;
  Brief brief;
  const auto solution = strike_with_captures(state, changes, brief);
  if (solution.outcome != LcpOutcome::solved) {
    state.v = v_before_;
    return solution;
  }
  const std::vector<TouchingContact> all = touching_and_bearings();  // with the rates that the impact left
  if (const std::size_t first = brief.first(); first < at_.touching.size()) {
    system_.move_to(state.t, state.q, state.v);
    const double taken = end_rocking(state, brief);  // the loss of all of them, reported for the first
    losses_.push_back({at_.touching[first].contact, taken});
    lost_elsewhere_ -= taken;
  }
  system_.move_to(state.t, state.q, state.v);
  lost_elsewhere_ += kinetic_before - system_.energy().kinetic;
  for (const TouchingContact& c : all) {
    losses_.push_back({c.contact, c.energy_lost()});
    lost_elsewhere_ -= c.energy_lost();
  }
  impact_warnings_.check(state.t, kinetic_before, rest_speed(all), all, cut_short_);
  return {LcpOutcome::solved, 0};
}

// Solves the impact from v_before_, again with e = 0 for rebounds that steps cannot follow, until there are none.
// `brief`: what is left that is too short to follow.
complementarity::ContactSolution ContactModes::strike_with_captures(State& state, const ContactChanges& changes,
                                                                    Brief& brief) {
  for (;;) {
    std::vector<TouchingContact> all = touching_and_bearings();
    const auto solution = solve_impacts(state, all);
    if (solution.outcome != LcpOutcome::solved) return solution;
    std::copy_n(all.begin(), at_.touching.size(), at_.touching.begin());
    std::copy_n(all.begin() + std::ptrdiff_t(at_.touching.size()), at_.bearings.size(), at_.bearings.begin());
    state.v = v_before_ + dv_;
    brief = too_brief(state, changes);
    if (!capture_chatter(brief.falls)) return solution;
    system_.move_to(state.t, state.q, v_before_);
  }
}

std::vector<TouchingContact> ContactModes::touching_and_bearings() const {
  std::vector<TouchingContact> all = at_.touching;
  all.insert(all.end(), at_.bearings.begin(), at_.bearings.end());
  return all;
}

// Sets dv_ and, in `all`, the impulses and the rates after the impact. Bodies that nothing connects strike apart, each
// group by its own law. It is not known which group needs an impact without collision, so these are solved together.
complementarity::ContactSolution ContactModes::solve_impacts(const State& state, std::vector<TouchingContact>& all) {
  const bool together =
      std::any_of(all.begin(), all.end(), [](const TouchingContact& c) { return c.without_collision; });
  std::map<std::size_t, std::vector<std::size_t>> islands;
  for (std::size_t i = 0; i < all.size(); ++i) islands[together ? 0 : scene_.scale.island(all[i].contact)].push_back(i);
  dv_.setZero(system_.sizes().nv);
  cut_short_ = false;
  std::size_t first = 0;  // index of the first island of this group
  Vec change;
  for (const auto& [number, members] : islands) {
    std::vector<TouchingContact> own;
    for (const std::size_t i : members) own.push_back(all[i]);
    const auto solution = impact_.solve(system_, state, rest_speed(own), own, change);
    if (solution.outcome != LcpOutcome::solved) return solution;
    cut_short_ = cut_short_ || impact_.cut_short();
    dv_ += change;
    for (std::size_t k = 0; k < members.size(); ++k) {
      all[members[k]] = own[k];
      all[members[k]].island += first;
    }
    first += members.size();
  }
  return {LcpOutcome::solved, 0};
}

// Rule 9: latches that touch without a rate lock.
void ContactModes::lock(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events) {
  model::Modes held = at_.before;
  const auto locked = [&](const TouchingContact& c) {
    if (!scene_.locks(c.contact) || !(contains(changes.struck, c.contact) || c.impulse > 0) ||
        c.after > scene_.scale.of(c.contact).rest_speed())
      return false;
    held.contacts[c.contact].closed = at_.modes.contacts[c.contact].closed = true;
    at_.modes.contacts[c.contact].approach_speed = -c.before;
    events.push_back({.t = state.t,
                      .kind = ContactEvent::Kind::latch,
                      .contact = c.contact,
                      .impulse = c.impulse,
                      .approach = -c.before,
                      .separation = c.after,
                      .energy_lost = c.energy_lost()});
    return true;
  };
  if (std::erase_if(at_.touching, locked) == 0) return;
  at_.before = held;
  system_.set_modes(held);
  system_.move_to(state.t, state.q, state.v);
}

double ContactModes::rest_speed(const std::vector<TouchingContact>& contacts) const {
  double largest = 0;
  for (const TouchingContact& c : contacts) largest = std::max(largest, scene_.scale.of(c.contact).rest_speed());
  return largest;
}

}  // namespace trammel::simulate
