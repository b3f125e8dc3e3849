#include "simulate/decision/participants.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/verdicts/errors_of_solutions.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;
using Tangent = Participant::Tangent;

namespace {

// Relative to the rates before an impact in its island: what it leaves in the rates that it ends.
constexpr double error_of_impacts = 1e-9;
// Of the speed that a fixed step changes: less is not resolved by such steps.
constexpr double part_of_step = 0.1;

}  // namespace

void Participants::open_all(model::Modes& modes) const {
  for (const TouchingContact& c : at_.touching)
    modes.contacts[c.contact].closed = false, modes.contacts[c.contact].friction = Friction::none;
  for (std::size_t i = 0; i < modes.contacts.size(); ++i)
    if (scene_.system.model().contacts[i].joint)
      modes.contacts[i].closed = false, modes.contacts[i].friction = Friction::none;
  modes.shared.clear();
}

// [m/s] Round-off that the impact leaves in the rates of this contact: of the rates before it in its island.
double Participants::error_of_impact(int contact) const {
  double scale = 0;
  for (const TouchingContact& c : at_.touching)
    if (scene_.scale.island(c.contact) == scene_.scale.island(contact))
      scale = std::max({scale, std::abs(c.before), c.slip_before.norm()});
  return error_of_impacts * scale;
}

std::vector<int> Participants::candidates(const ContactChanges& changes) const {
  std::vector<int> all;
  for (const TouchingContact& c : at_.touching) {
    const double rest_speed = error_of_impact(c.contact) + scene_.scale.of(c.contact).rest_speed();
    const bool constrained = c.impulse > 0 && scene_.treatment(c.contact).rebound == Restitution::Rebound::constrained;
    const bool rests = std::abs(c.after) <= rest_speed || c.rests_as_before(rest_speed);
    const bool released = contains(changes.released, c.contact) && c.impulse == 0 && !at_.shared_before[c.contact];
    if ((rests || constrained) && !released) all.push_back(c.contact);
  }
  return all;
}

// [m/s] Slip across its former direction that counts as none; with fixed steps also what a part of a step takes away.
double Participants::unresolved(int contact, const State& state) const {
  const model::ContactMode& mode = at_.before.contacts[contact];
  if (!scene_.steps.fixed || scene_.system.tangents(contact) == 1) return mode.least_slip;
  const double in_a_step = *scene_.steps.fixed * scene_.system.slip_acceleration(contact, state.a).norm();
  return std::max(mode.least_slip, part_of_step * in_a_step);
}

double Participants::least_acceleration(int contact) const {
  const double largest = at_.largest.empty() ? 0 : at_.largest[std::size_t(contact)];
  return std::max(scene_.scale.of(contact).no_acceleration(), error_of_accelerations * largest);
}

void Participants::add_friction(const Occasion& now, Participant& p) const {
  const model::ContactEntry& entry = scene_.system.model().contacts[p.contact];
  if (!entry.friction) return;
  const Tangential slip = scene_.system.slip(p.contact);
  if (!entry.smooth) return add_set_valued_friction(now, *entry.coulomb, slip, p);
  const double speed = slip.norm();
  p.tangent = Tangent::sliding;
  if (speed > 0) p.ratio = -entry.smooth->ratio(speed) * direction_of(slip);
}

void Participants::add_set_valued_friction(const Occasion& now, const SetValuedFriction& law, const Tangential& slip,
                                           Participant& p) const {
  const double speed = slip.norm();
  p.mu_0 = law.static_coefficient();
  p.mu = law.kinetic_coefficient(speed);
  if (p.mu_0 == 0) return;
  const model::ContactMode& before = at_.before.contacts[p.contact];
  const bool was_closed = before.closed && before.friction != Friction::none;
  const double rest_speed = std::max(scene_.stick_speed(p.contact), now.jumped ? error_of_impact(p.contact) : 0);
  bool rests = speed <= rest_speed;
  Tangential unit = direction_of(slip);
  p.direction = unit;
  if (was_closed && !now.jumped) {
    const model::SlipDirection goes(slip, before.direction, before.least_slip);
    const bool stopped = contains(now.changes.stopped, p.contact);
    rests =
        before.friction == Friction::stick || (stopped && std::abs(goes.across()) <= unresolved(p.contact, now.state));
    if (!stopped) {
      unit = goes.unit();
      // A slower slip keeps turning from the direction that it had (system/point/slip.hpp).
      p.direction = goes.along() > before.least_slip ? unit : before.direction;
    }
  }
  p.tangent = rests ? Tangent::resting : Tangent::sliding;
  if (!rests) p.ratio = -p.mu * unit;
  p.let_go = p.yielded = rests && !at_.shared_before[p.contact] && contains(now.changes.yielded, p.contact) &&
                         law.decide() == SetValuedFriction::Decide::at_events;
}

std::vector<Participant> Participants::gather(const std::vector<int>& candidates, const Occasion& now) {
  std::vector<Participant> who;
  for (const int i : candidates) {
    Participant p{.contact = i};
    add_friction(now, p);
    p.slid_until_now = at_.before.contacts[i].closed && at_.before.contacts[i].friction == Friction::slide;
    p.pressed_until_now = at_.pressed_until_now(i);
    who.push_back(p);
  }
  for (int i = 0; i < int(at_.modes.contacts.size()); ++i) {
    const model::ContactEntry& entry = scene_.system.model().contacts[i];
    if (entry.joint) {
      Participant p{.contact = i, .unilateral = false, .given_pushes = true};
      add_friction(now, p);
      who.push_back(p);
    } else if (entry.force && entry.coulomb && at_.modes.contacts[i].closed) {
      gather_compliant(i, now, who);
    }
  }
  return who;
}

// One that slides takes no part: its friction is known.
void Participants::gather_compliant(int contact, const Occasion& now, std::vector<Participant>& who) {
  Participant p{.contact = contact, .unilateral = false};
  add_friction(now, p);
  model::ContactMode& mode = at_.modes.contacts[contact];
  mode.friction = p.tangent == Tangent::sliding ? Friction::slide : Friction::none;
  mode.direction = p.direction;
  mode.least_slip = scene_.least_slip(contact);
  if (p.tangent == Tangent::resting) who.push_back(p);
}

void Participants::accelerate(ContactProblem& problem) {
  Vec a, lambda;
  scene_.system.accelerate({}, a, lambda);
  const std::vector<std::size_t> island = problem.islands();
  std::vector<double> largest(island.size(), 0), least(island.size(), 0);  // by island
  for (std::size_t i = 0; i < island.size(); ++i) {
    Participant& p = problem.who[i];
    if (!p.unilateral) p.given = scene_.system.normal_force(p.contact, lambda);
    p.least_slip = scene_.scale.of(p.contact).no_acceleration();
    p.a_n = scene_.system.acceleration({p.contact, 0}, a);
    if (p.tangent != Tangent::none) p.a_t = scene_.system.slip_acceleration(p.contact, a);
    largest[island[i]] = std::max({largest[island[i]], std::abs(p.a_n), p.a_t.norm()});
    least[island[i]] = std::max(least[island[i]], p.least_slip);
  }
  at_.largest.assign(at_.modes.contacts.size(), 0);
  for (std::size_t i = 0; i < island.size(); ++i) {
    Participant& p = problem.who[i];
    at_.largest[std::size_t(p.contact)] = largest[island[i]];
    p.nothing = std::max(least[island[i]], error_of_accelerations * largest[island[i]]);
  }
}

}  // namespace trammel::simulate
