#include "simulate/settling/contact_mode.hpp"

#include <algorithm>

#include "simulate/settling/contact_events.hpp"
#include "simulate/settling/latches.hpp"
#include "simulate/settling/pressed_until_now.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;
using Friction = model::ContactMode::Friction;
using Kind = ContactEvent::Kind;

namespace {

// Below this part of the scene's speed a contact begins at rest: it has no approach speed, and a damping law that
// scales with 1/approach_speed gives no damping. (Otherwise 1/speed would hold it with an unbounded viscosity, which
// fixed steps cannot follow.)
constexpr double least_approach = 1e-6;

}  // namespace

void ContactModes::settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events) {
  begin(state);
  toggle(state, changes.toggled, events);
  const bool jumped = strike(state, changes);
  lock_latches(scene_, state, changes, at_, events);
  auto solution = decision_.decide(state, changes, jumped);
  const bool without_collision = solution.outcome == LcpOutcome::no_solution && (changes.locked || any_friction());
  if (without_collision) solution = without_collision_.strike(state, changes, jumped, events);
  if (solution.outcome != LcpOutcome::solved)
    fail_without_balance(scene_, unsolved(state.t, solution), decision_.instant().problem().who);
  take_approach_speeds(changes);
  append_impacts(scene_, at_, state.t, without_collision, events);
  take_modes(state, changes);
  append_normal_events(at_, state.t, decision_.instant().candidates(), events);
  append_friction_events(scene_, at_, state, events);
}

void ContactModes::begin(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  at_.before = at_.modes = system_.modes();
  at_.largest.assign(at_.modes.contacts.size(), 0);  // values of an earlier event would be unknown to a resumed run
  at_.shared_before.resize(system_.model().contacts.size());
  for (std::size_t i = 0; i < at_.shared_before.size(); ++i) at_.shared_before[i] = system_.sharing(int(i)).shared;
  carried_.keep(state, at_.before);
  find_pressed(scene_, at_);
  impacts_.forget_losses();
}

// True if v has jumped.
bool ContactModes::strike(State& state, const ContactChanges& changes) {
  impacts_.find_touching(changes);
  impacts_.find_bearings();
  if (changes.struck.empty() || !any_approaches()) return false;
  const auto impact = impacts_.strike(state, changes);
  if (impact.outcome != LcpOutcome::solved) fail_without_impact(scene_, unsolved(state.t, impact), at_);
  forget_pressed_by_impact(scene_, at_);
  return true;
}

// Only friction makes forces grow beyond all bounds: without it an impact without collision changes nothing.
bool ContactModes::any_friction() const {
  const std::vector<Participant>& who = decision_.instant().problem().who;
  return std::any_of(who.begin(), who.end(),
                     [](const Participant& p) { return p.tangent != Participant::Tangent::none; });
}

bool ContactModes::any_approaches() const {
  return std::any_of(at_.touching.begin(), at_.touching.end(),
                     [this](const TouchingContact& c) { return c.before < -scene_.scale.of(c.contact).rest_speed(); });
}

void ContactModes::take_approach_speeds(const ContactChanges& changes) {
  for (const TouchingContact& c : at_.touching)
    if (contains(changes.struck, c.contact) || (!c.was_closed && c.impulse > 0))
      at_.modes.contacts[c.contact].approach_speed = -c.before;
}

void ContactModes::toggle(const State& state, const std::vector<int>& contacts, std::vector<ContactEvent>& events) {
  for (const int i : contacts) {
    model::ContactMode& mode = at_.modes.contacts[i];
    const double rate = system_.gap_rate(i);
    mode.closed = !mode.closed;
    mode.friction = Friction::none;
    if (mode.closed) mode.approach_speed = -rate > least_approach * scene_.scale.of(i).speed ? -rate : 0;
    events.push_back({.t = state.t,
                      .kind = mode.closed ? Kind::close : Kind::open,
                      .contact = i,
                      .approach = -rate,
                      .separation = rate});
  }
}

// The system takes the new modes; a and lambda follow, or lambda is carried over.
void ContactModes::take_modes(State& state, const ContactChanges& changes) {
  const bool carry = carried_.asked(at_, changes) && state.a.size() == system_.sizes().nv;  // the start has no a yet
  system_.set_modes(at_.modes);
  system_.move_to(state.t, state.q, state.v);
  if (carry)
    carried_.take(state.lambda);
  else
    system_.accelerate({}, state.a, state.lambda);
}

}  // namespace trammel::simulate
