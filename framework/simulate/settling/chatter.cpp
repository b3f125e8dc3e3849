#include "simulate/settling/chatter.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {

using complementarity::LcpOutcome;
using Tangent = Participant::Tangent;

std::size_t BriefMotions::first() const {
  std::size_t i = 0;
  while (i < falls.size() && !falls[i] && !stops[i]) ++i;
  return i;
}

bool Chatter::cannot_follow(int contact, double separation, double acceleration) const {
  if (!(acceleration < 0)) return false;
  if (scene_.steps.fixed) return 2 * separation < scene_.chatter_steps * *scene_.steps.fixed * -acceleration;
  const double error = scene_.scale.of(contact).error_of_position(scene_.steps.tolerance);
  return separation * separation < scene_.chatter_steps * error * 2 * -acceleration;
}

// It parts by its own rebound or by the impulses of others, whether it was closed, only touched, or was pressed in the
// same impact. If one of these were left out, two corners of a box would throw each other up in turn, without end. With
// e = 1 flights do not become shorter.
bool Chatter::separates(const TouchingContact& c) const {
  return !c.keeps_rates && c.restitution < 1 && c.after > scene_.scale.of(c.contact).rest_speed();
}

// It stuck or was open, and slips after the impact. (An impact is decided by impulses; the finite load contributes
// none.)
bool Chatter::begins_to_slip(const TouchingContact& c) const {
  const bool slid = c.was_closed && at_.before.contacts[c.contact].friction != Friction::stick;
  return !c.keeps_rates && !slid && c.slip_after.norm() > scene_.scale.of(c.contact).rest_speed();
}

const TouchingContact* Chatter::beginning_to_slip(const Participant& p) const {
  const auto c = std::find_if(at_.touching.begin(), at_.touching.end(),
                              [&](const TouchingContact& each) { return each.contact == p.contact; });
  return c != at_.touching.end() && begins_to_slip(*c) ? &*c : nullptr;
}

// All contacts with so small a separation or slip are judged together: in a pile each flies only as long as its
// neighbours do. The problem of forces is solved as if all of them rested. Those that press in it fall back, with the
// acceleration that their own force prevents; those that stick stop, with the deceleration that their friction can
// still give.
BriefMotions Chatter::too_brief(const State& state, const ContactChanges& changes) {
  BriefMotions brief{std::vector<bool>(at_.touching.size(), false), std::vector<bool>(at_.touching.size(), false)};
  const auto moves = [this](const TouchingContact& c) { return separates(c) || begins_to_slip(c); };
  if (scene_.chatter_steps <= 0 || std::none_of(at_.touching.begin(), at_.touching.end(), moves)) return brief;
  scene_.system.move_to(state.t, state.q, state.v);
  candidates_ = participants_.candidates(changes);
  const std::size_t at_rest_now = candidates_.size();
  model::Modes open = at_.modes;
  participants_.open_all(open);
  scene_.system.set_modes(open);
  scene_.system.move_to(state.t, state.q, state.v);
  std::map<std::size_t, double> fastest = fastest_gap_accelerations();
  for (const TouchingContact& c : at_.touching)
    if (separates(c) && !contains(candidates_, c.contact) &&
        cannot_follow(c.contact, c.after, -fastest[scene_.scale.island(c.contact)]))
      candidates_.push_back(c.contact);
  problem_.who = participants_.gather(candidates_, {state, changes, true});
  bool slips = false;
  for (Participant& p : problem_.who)
    if (p.tangent == Tangent::sliding && beginning_to_slip(p)) p.tangent = Tangent::resting, slips = true;
  if (slips || candidates_.size() > at_rest_now) judge(state, at_rest_now, brief);
  scene_.system.set_modes(at_.before);
  scene_.system.move_to(state.t, state.q, state.v);
  return brief;
}

// Solves at the velocities that are left when these rates have ended. With those before, a table that rocks would need
// accelerations omega^2 r at its feet, and contacts that depend on each other may have no forces that give them.
// Without a solution all rates go on; no proof is needed that there is none.
void Chatter::judge(const State& state, std::size_t at_rest_now, BriefMotions& brief) {
  problem_.prepare(scene_.system);
  Vec change;
  problem_.come_to_rest(scene_.system, change);
  scene_.system.move_to(state.t, state.q, state.v + change);
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

bool Chatter::stops_at_once(std::size_t participant) const {
  const Participant& p = problem_.who[participant];
  return p.a_t.norm() <= p.nothing && cannot_follow(p.contact, beginning_to_slip(p)->slip_after.norm(),
                                                    -problem_.deceleration_to_spare(participant));
}

// Contacts whose slip is not ended at once by friction slide instead of resting. True if there are any: the forces must
// be found again.
bool Chatter::let_fast_slips_go() {
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
std::map<std::size_t, double> Chatter::fastest_gap_accelerations() const {
  Vec a, lambda;
  scene_.system.accelerate({}, a, lambda);
  std::map<std::size_t, double> fastest;
  for (const TouchingContact& c : at_.touching) {
    double& own = fastest[scene_.scale.island(c.contact)];
    own = std::max(own, std::abs(scene_.system.acceleration({c.contact, 0}, a)));
  }
  return fastest;
}

}  // namespace trammel::simulate
