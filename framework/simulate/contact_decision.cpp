// Rules 3 to 7 of contact_mode.hpp: which contacts close, open, stick and slide, by the complementarity problem.
#include <algorithm>
#include <cmath>

#include "simulate/contact_mode.hpp"

namespace trammel::simulate {
namespace {

using Tangent = Participant::Tangent;

double sign(double x) {
  return std::copysign(1.0, x);
}

}  // namespace

void ContactModes::open_all(model::Modes& modes) const {
  for (const TouchingContact& c : touching_)
    modes.contacts[c.contact].closed = false, modes.contacts[c.contact].friction = Friction::none;
}

void ContactModes::find_candidates(const ContactChanges& changes) {
  candidates_.clear();
  double scale = 0;
  for (const TouchingContact& c : touching_) scale = std::max(scale, std::abs(c.before));
  const double at_rest = 1e-9 * scale + scale_.at_rest();  // [m/s] round-off of the jump
  for (const TouchingContact& c : touching_) {
    const bool constrained = c.impulse > 0 && treatment(c.contact).rebound == Restitution::Rebound::constrained;
    const bool rests = std::abs(c.was_closed ? c.after - c.before : c.after) <= at_rest;
    const bool released = contains(changes.released, c.contact) && c.impulse == 0 && !redundant_;
    if ((rests || constrained) && !released) candidates_.push_back(c.contact);
  }
}

double ContactModes::nothing() const {
  return std::max(scale_.no_acceleration(), 1e-12 * largest_);
}

// Rule 5: whether the contact is at rest in the tangent, and its coefficients.
void ContactModes::add_friction(Participant& p, const ContactChanges& changes, bool jumped) {
  const model::ContactEntry& entry = system_.model().contacts[p.contact];
  if (!entry.friction) return;
  const double slip = system_.rate({p.contact, 1});
  if (entry.smooth) {
    p.tangent = Tangent::sliding;
    p.ratio = std::copysign(entry.smooth->ratio(std::abs(slip)), -slip);
    return;
  }
  p.mu_0 = entry.coulomb->static_coefficient();
  p.mu = entry.coulomb->kinetic_coefficient(std::abs(slip));
  if (p.mu_0 == 0) return;
  const model::ContactMode& before = before_.contacts[p.contact];
  const bool was_closed = before.closed && before.friction != Friction::none;
  double at_rest = std::max(scale_.at_rest(), entry.coulomb->stick_speed());
  if (jumped)
    for (const TouchingContact& c : touching_) at_rest = std::max(at_rest, 1e-9 * std::abs(c.before));
  bool rests = std::abs(slip) <= at_rest;
  if (was_closed && !jumped) rests = before.friction == Friction::stick || contains(changes.stopped, p.contact);
  p.direction = was_closed && !jumped ? before.direction : sign(slip);
  p.tangent = rests ? Tangent::resting : Tangent::sliding;
  if (!rests) p.ratio = -p.mu * p.direction;
  p.let_go = rests && !redundant_ && contains(changes.yielded, p.contact) &&
             entry.coulomb->decide() == SetValuedFriction::Decide::at_events;
}

// Who takes part: candidates of rule 3, and compliant contacts at rest in the tangent.
void ContactModes::gather(const ContactChanges& changes, bool jumped) {
  problem_.who.clear();
  for (const int i : candidates_) {
    Participant p;
    p.contact = i;
    add_friction(p, changes, jumped);
    problem_.who.push_back(p);
  }
  for (int i = 0; i < int(modes_.contacts.size()); ++i) {
    model::ContactMode& mode = modes_.contacts[i];
    if (!mode.closed || !system_.model().contacts[i].force || !system_.model().contacts[i].coulomb) continue;
    Participant p;
    p.contact = i;
    p.unilateral = false;
    add_friction(p, changes, jumped);
    mode.friction = p.tangent == Tangent::sliding ? Friction::slide : Friction::none;
    mode.direction = p.direction;
    if (p.tangent == Tangent::resting) problem_.who.push_back(p);
  }
}

// Rules 3, 5 and 6.
bool ContactModes::decide(State& state, const ContactChanges& changes, bool jumped) {
  gather(changes, jumped);
  open_all(modes_);
  if (problem_.who.empty()) return true;
  problem_.prepare(system_);
  bool drifted = false;
  for (Participant& p : problem_.who) {
    if (p.tangent != Tangent::resting) continue;
    p.a_t = system_.rate({p.contact, 1});
    drifted = drifted || (std::abs(p.a_t) > scale_.at_rest() &&
                          system_.model().contacts[p.contact].coulomb->stick_speed() < std::abs(p.a_t));
  }
  if (drifted) {
    problem_.end_slip(dv_);
    state.v += dv_;
  }
  system_.set_modes(modes_);
  system_.move_to(state.t, state.q, state.v);
  accelerate_participants();
  if (!problem_.solve(nothing())) return false;
  for (const Participant& p : problem_.who) take_verdict(p, changes);
  return true;
}

// Accelerations without the forces sought, and the forces given.
void ContactModes::accelerate_participants() {
  system_.accelerate({}, a_, lambda_);
  largest_ = 0;
  for (Participant& p : problem_.who) {
    if (!p.unilateral) p.given = system_.normal_force(p.contact, lambda_);
    p.a_n = p.free_n = system_.acceleration({p.contact, 0}, a_);
    if (p.tangent != Tangent::none) p.a_t = system_.acceleration({p.contact, 1}, a_);
    largest_ = std::max({largest_, std::abs(p.a_n), std::abs(p.a_t)});
  }
}

// Of redundant contacts the solution loads only some; the others carry nothing, but what holds them where they would move
// without it is shared by them: they are held too.
bool ContactModes::stays_closed(const Participant& p) const {
  return !p.unilateral || p.N > 0 || (p.a_n <= nothing() && std::abs(p.free_n) > nothing());
}

void ContactModes::take_verdict(const Participant& p, const ContactChanges& changes) {
  model::ContactMode& mode = modes_.contacts[p.contact];
  mode.closed = stays_closed(p);
  mode.friction = Friction::none;
  if (!mode.closed || p.tangent == Tangent::none || !system_.model().contacts[p.contact].coulomb) return;
  mode.friction = Friction::slide;
  mode.direction = p.direction;
  if (p.tangent == Tangent::sliding) return;
  if (std::abs(p.a_t) > nothing()) {
    mode.direction = sign(p.a_t);
  } else if (contains(changes.yielded, p.contact) && held_by_[p.contact] != 0 && !redundant_) {
    mode.direction = -sign(held_by_[p.contact]);
  } else {
    mode.friction = Friction::stick;
    if (before_.contacts[p.contact].friction != Friction::stick) mode.anchor = system_.coordinate({p.contact, 1});
  }
}

const std::vector<ContactModes::Verdict>& ContactModes::foresee(const State& state) {
  const model::Modes now = system_.modes();
  before_ = modes_ = now;
  const ContactChanges none;
  touching_.clear(), candidates_.clear();
  for (int i = 0; i < int(now.contacts.size()); ++i)
    if (now.contacts[i].closed && system_.model().contacts[i].restitution && !locks(i))
      touching_.push_back({.contact = i, .was_closed = true}), candidates_.push_back(i);
  verdicts_.assign(now.contacts.size(), {});
  gather(none, false);
  problem_.prepare(system_);
  open_all(modes_);
  system_.set_modes(modes_);
  system_.move_to(state.t, state.q, state.v);
  accelerate_participants();
  const bool solved = problem_.solve(nothing());
  for (const Participant& p : problem_.who)
    verdicts_[p.contact] = {!solved || !stays_closed(p),
                            p.tangent == Tangent::resting && (!solved || std::abs(p.a_t) > nothing())};
  system_.set_modes(now);
  return verdicts_;
}

}  // namespace trammel::simulate
