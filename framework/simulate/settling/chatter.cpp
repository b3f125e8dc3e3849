// Rule 2 of contact_mode.hpp: motions after an impact that steps cannot follow.
#include <algorithm>
#include <cmath>
#include <set>

#include "simulate/contact/ending_impulses.hpp"
#include "simulate/settling/contact_mode.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;
using Tangent = Participant::Tangent;

std::size_t ContactModes::Brief::first() const {
  std::size_t i = 0;
  while (i < falls.size() && !falls[i] && !stops[i]) ++i;
  return i;
}

bool ContactModes::cannot_follow(int contact, double separation, double acceleration) const {
  if (!(acceleration < 0)) return false;
  if (scene_.steps.fixed) return 2 * separation < scene_.chatter_steps * *scene_.steps.fixed * -acceleration;
  const double error = scene_.scale.of(contact).error_of_position(scene_.steps.tolerance);
  return separation * separation < scene_.chatter_steps * error * 2 * -acceleration;
}

// It parts by its own rebound or by the impulses of others, whether it was closed, only touched, or was pressed in the
// same impact. If one of these were left out, two corners of a box would throw each other up in turn, without end. With
// e = 1 flights do not become shorter.
bool ContactModes::separates(const TouchingContact& c) const {
  return !c.keeps_rates && c.restitution < 1 && c.after > scene_.scale.of(c.contact).rest_speed();
}

// It stuck or was open, and slips after the impact. (An impact is decided by impulses; the finite load contributes
// none.)
bool ContactModes::begins_to_slip(const TouchingContact& c) const {
  const bool slid = c.was_closed && at_.before.contacts[c.contact].friction != Friction::stick;
  return !c.keeps_rates && !slid && c.slip_after.norm() > scene_.scale.of(c.contact).rest_speed();
}

const TouchingContact* ContactModes::beginning_to_slip(const Participant& p) const {
  const auto c = std::find_if(at_.touching.begin(), at_.touching.end(),
                              [&](const TouchingContact& each) { return each.contact == p.contact; });
  return c != at_.touching.end() && begins_to_slip(*c) ? &*c : nullptr;
}

// All contacts with so small a separation or slip are judged together: in a pile each flies only as long as its
// neighbours do. The problem of forces is solved as if all of them rested. Those that press in it fall back, with the
// acceleration that their own force prevents; those that stick stop, with the deceleration that their friction can
// still give.
ContactModes::Brief ContactModes::too_brief(const State& state, const ContactChanges& changes) {
  Brief brief{std::vector<bool>(at_.touching.size(), false), std::vector<bool>(at_.touching.size(), false)};
  const auto moves = [this](const TouchingContact& c) { return separates(c) || begins_to_slip(c); };
  if (scene_.chatter_steps <= 0 || std::none_of(at_.touching.begin(), at_.touching.end(), moves)) return brief;
  system_.move_to(state.t, state.q, state.v);
  candidates_ = participants_.candidates(changes);
  const std::size_t at_rest_now = candidates_.size();
  model::Modes open = at_.modes;
  participants_.open_all(open);
  system_.set_modes(open);
  system_.move_to(state.t, state.q, state.v);
  std::map<std::size_t, double> fastest = fastest_gap_accelerations();
  for (const TouchingContact& c : at_.touching)
    if (separates(c) && !contains(candidates_, c.contact) &&
        cannot_follow(c.contact, c.after, -fastest[scene_.scale.island(c.contact)]))
      candidates_.push_back(c.contact);
  problem_.who = participants_.gather(candidates_, {state, changes, true});
  bool slips = false;
  for (Participant& p : problem_.who)
    if (p.tangent == Tangent::sliding && beginning_to_slip(p)) p.tangent = Tangent::resting, slips = true;
  if (slips || candidates_.size() > at_rest_now) judge_brief(state, at_rest_now, brief);
  system_.set_modes(at_.before);
  system_.move_to(state.t, state.q, state.v);
  return brief;
}

// Solves at the velocities that are left when these rates have ended. With those before, a table that rocks would need
// accelerations omega^2 r at its feet, and contacts that depend on each other may have no forces that give them.
// Without a solution all rates go on; no proof is needed that there is none.
void ContactModes::judge_brief(const State& state, std::size_t at_rest_now, Brief& brief) {
  problem_.prepare(system_);
  Vec change;
  problem_.come_to_rest(system_, change);
  system_.move_to(state.t, state.q, state.v + change);
  do {
    participants_.accelerate(problem_);
    if (problem_.solve({}, complementarity::ModeSearch::none).outcome != LcpOutcome::solved) return;
  } while (let_fast_slips_go());
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const Participant& p = problem_.who[i];
    const auto c = std::find_if(at_.touching.begin(), at_.touching.end(),
                                [&](const TouchingContact& each) { return each.contact == p.contact; });
    if (c == at_.touching.end() || !(p.N > 0)) continue;
    const auto k = std::size_t(c - at_.touching.begin());
    brief.stops[k] = p.tangent == Tangent::resting && begins_to_slip(*c);
    brief.falls[k] = i >= at_rest_now && i < candidates_.size() &&
                     cannot_follow(c->contact, c->after, problem_.acceleration_without(i));
  }
}

bool ContactModes::stops_at_once(std::size_t participant) const {
  const Participant& p = problem_.who[participant];
  return p.a_t.norm() <= p.nothing && cannot_follow(p.contact, beginning_to_slip(p)->slip_after.norm(),
                                                    -problem_.deceleration_to_spare(participant));
}

// Contacts whose slip is not ended at once by friction slide instead of resting. True if there are any: the forces must
// be found again.
bool ContactModes::let_fast_slips_go() {
  bool any = false;
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    Participant& p = problem_.who[i];
    if (p.tangent != Tangent::resting || !beginning_to_slip(p) || !(p.N > 0) || stops_at_once(i)) continue;
    p.tangent = Tangent::sliding;
    p.ratio = -p.mu * p.direction;
    any = true;
  }
  return any;
}

// [m/s^2] By island of the scene.
std::map<std::size_t, double> ContactModes::fastest_gap_accelerations() {
  system_.accelerate({}, a_, lambda_);
  std::map<std::size_t, double> fastest;
  for (const TouchingContact& c : at_.touching) {
    double& own = fastest[scene_.scale.island(c.contact)];
    own = std::max(own, std::abs(system_.acceleration({c.contact, 0}, a_)));
  }
  return fastest;
}

// Sets e = 0 for rebounds that are too short to follow; true if there are any.
bool ContactModes::capture_chatter(const std::vector<bool>& falls) {
  bool captured = false;
  for (std::size_t i = 0; i < at_.touching.size(); ++i)
    if (falls[i] && at_.touching[i].restitution > 0) at_.touching[i].restitution = 0, captured = true;
  return captured;
}

// Ends separations and slips that are too short to follow; impacts of other contacts have caused them. Contacts that
// nothing connects with these keep all their rates, drift included. Returns the energy that this takes [J].
double ContactModes::end_rocking(State& state, const Brief& brief) {
  std::set<std::size_t> islands;  // of the scene
  for (std::size_t i = 0; i < at_.touching.size(); ++i)
    if (brief.falls[i] || brief.stops[i]) islands.insert(scene_.scale.island(at_.touching[i].contact));
  double taken = 0;
  for (const std::size_t island : islands) taken += end_rocking_of(island, state, brief);
  return taken;
}

// Separations may be too short to follow although their motion is not: a block that turns about its lower corner while
// the upper corner of the block below, nearly at the same point, parts from it. To end both rates takes away the whole
// motion; to end one makes the other one approach, so that its impact would restore them, without end. So the fastest
// rates go on, as few as let all others end without this.
double ContactModes::end_rocking_of(std::size_t island, State& state, Brief brief) {
  const std::vector<TouchingContact> after_impact = at_.touching;
  const Vec v_after_impact = state.v;
  do {
    const double taken = end_rates_of(island, state, brief);
    if (none_made_to_approach(island, after_impact)) return taken;
    at_.touching = after_impact;
    state.v = v_after_impact;
    system_.move_to(state.t, state.q, state.v);
  } while (leave_fastest(island, brief));
  return 0;
}

// Of contacts whose rows depend on each other, some keep the rate that another one would have to exceed (corners at one
// point, of bodies that turn against each other): these part.
double ContactModes::end_rates_of(std::size_t island, State& state, const Brief& brief) {
  const auto asked = [&](const TouchingContact& c) { return scene_.scale.island(c.contact) == island; };
  const auto rest_speed = [this](const TouchingContact& c) { return scene_.scale.of(c.contact).rest_speed(); };
  std::vector<bool> rests(at_.touching.size(), false);
  for (std::size_t i = 0; i < at_.touching.size(); ++i)  // one whose slip stops may have a rate that steps left
    rests[i] = asked(at_.touching[i]) &&
               (brief.falls[i] || brief.stops[i] || at_.touching[i].after <= rest_speed(at_.touching[i]));
  double taken = 0;
  for (bool any = true; any;) {
    taken += take_rates(state, rests, brief.stops);
    any = false;
    for (std::size_t i = 0; i < at_.touching.size(); ++i) {
      TouchingContact& c = at_.touching[i];
      if (!asked(c)) continue;
      const double left = system_.gap_rate(c.contact);
      c.after = rests[i] && std::abs(left) <= scene_.scale.of(c.contact).left_by_impacts() ? 0 : left;
      if (!rests[i] && c.after < -rest_speed(c)) rests[i] = any = true;
    }
  }
  return taken;
}

bool ContactModes::none_made_to_approach(std::size_t island, const std::vector<TouchingContact>& after_impact) const {
  return std::none_of(after_impact.begin(), after_impact.end(), [&](const TouchingContact& c) {
    const double least = -scene_.scale.of(c.contact).left_by_impacts();
    return scene_.scale.island(c.contact) == island && system_.gap_rate(c.contact) < std::min(c.after, 0.0) + least;
  });
}

// The fastest of the island's rates that were to end goes on; true if others are left to end.
bool ContactModes::leave_fastest(std::size_t island, Brief& brief) const {
  std::size_t fastest = 0, rates = 0;
  double largest = 0;
  for (std::size_t i = 0; i < at_.touching.size(); ++i) {
    const TouchingContact& c = at_.touching[i];
    if (scene_.scale.island(c.contact) != island || !(brief.falls[i] || brief.stops[i])) continue;
    ++rates;
    const double rate = std::max(brief.falls[i] ? c.after : 0, brief.stops[i] ? c.slip_after.norm() : 0);
    if (rate > largest) largest = rate, fastest = i;
  }
  if (rates < 2) return false;
  brief.falls[fastest] = brief.stops[fastest] = false;
  return true;
}

// The least change of v, so a loss of energy, after which the contacts in `rests` have no rate. The returned loss is
// the work of the impulses against the rates that they end; it does not include work of a moving base.
double ContactModes::take_rates(State& state, const std::vector<bool>& rests, const std::vector<bool>& stops) {
  std::vector<model::ContactDirection> held;
  for (std::size_t i = 0; i < at_.touching.size(); ++i) {
    const TouchingContact& c = at_.touching[i];
    if (!rests[i]) continue;
    held.push_back({c.contact, 0});
    const bool sticks = stops[i] || c.slip_after.norm() <= scene_.scale.of(c.contact).rest_speed();
    if (system_.model().contacts[c.contact].coulomb && sticks)
      for (int k = 1; k <= system_.tangents(c.contact); ++k) held.push_back({c.contact, k});
  }
  Vec rates(Eigen::Index(held.size()));
  for (std::size_t i = 0; i < held.size(); ++i) rates[Eigen::Index(i)] = system_.rate(held[i]);
  Mat jump, delassus;
  system_.impulse_response(held, jump, delassus);
  const Vec impulses = ending_impulses(delassus, rates);
  state.v += jump * impulses;
  system_.move_to(state.t, state.q, state.v);
  return -impulses.dot(rates + 0.5 * (delassus * impulses));
}

}  // namespace trammel::simulate
