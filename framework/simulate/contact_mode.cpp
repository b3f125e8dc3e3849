#include "simulate/contact_mode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "simulate/run_failed.hpp"

namespace trammel::simulate {
namespace {

using Tangent = Participant::Tangent;

bool contains(const std::vector<int>& list, int i) {
  return std::find(list.begin(), list.end(), i) != list.end();
}

double sign(double x) {
  return std::copysign(1.0, x);
}

// A contact that comes to rest at its onset has no approach speed for a damping law to scale with; this part of the scene's
// speed is the least it gets.
constexpr double least_approach = 1e-6;

}  // namespace

bool ContactModes::any_closed() const {
  const auto& contacts = system_.modes().contacts;
  return std::any_of(contacts.begin(), contacts.end(), [](const model::ContactMode& mode) { return mode.closed; });
}

double ContactModes::settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events) {
  const int n = int(system_.model().contacts.size());
  system_.move_to(state.t, state.q, state.v);
  before_ = modes_ = system_.modes();
  rows_before_.resize(n), sticks_before_.resize(n);
  for (int i = 0; i < n; ++i) rows_before_[i] = system_.contact_row(i), sticks_before_[i] = system_.stick_row(i);
  lambda_before_ = state.lambda;
  forces_before(state, changes);
  toggle(state, changes.toggled, events);
  find_touching(changes);
  const auto approaches = [this](const TouchingContact& c) { return c.before < -scale_.at_rest(); };
  bool jumped = !changes.struck.empty() && std::any_of(touching_.begin(), touching_.end(), approaches);
  double elsewhere = jumped ? strike(state) : 0;
  bool without_collision = false;
  find_candidates(changes);
  if (!decide(state, changes, jumped)) {  // rule 8
    if (jumped) fail_without_solution("balance of forces");
    jumped = without_collision = true;
    system_.set_modes(before_);
    system_.move_to(state.t, state.q, state.v);
    elsewhere += strike(state);
    find_candidates(changes);
    if (!decide(state, changes, jumped)) fail_without_solution("balance of forces");
  }
  bool carry = false;
  for (const TouchingContact& c : touching_) {
    const bool struck = contains(changes.struck, c.contact);
    carry = carry || ((struck || contains(changes.released, c.contact)) &&
                      treatment(c.contact).restart == Restitution::Restart::carry);
    if (c.impulse > 0 && (!c.was_closed || without_collision))
      events.push_back({.t = state.t,
                        .contact = c.contact,
                        .impulse = c.impulse,
                        .approach = -c.before,
                        .separation = c.after,
                        .energy_lost = c.energy_lost(),
                        .friction = c.friction});
    if (struck || (!c.was_closed && c.impulse > 0)) modes_.contacts[c.contact].approach_speed = -c.before;
  }
  finish(state, carry);
  for (const TouchingContact& c : touching_) tell_normal(state, c, events);
  tell_friction(state, events);
  return elsewhere;
}

// What held the contacts that now yield; whether rows were redundant.
void ContactModes::forces_before(const State&, const ContactChanges& changes) {
  held_by_.assign(system_.model().contacts.size(), 0.0);
  redundant_ = false;
  if (changes.yielded.empty() && changes.released.empty()) return;
  system_.accelerate({}, a_, lambda_);
  redundant_ = system_.redundant();
  for (const int i : changes.yielded) held_by_[i] = system_.friction_force(i, lambda_);
}

void ContactModes::toggle(const State& state, const std::vector<int>& contacts, std::vector<ContactEvent>& events) {
  for (const int i : contacts) {
    model::ContactMode& mode = modes_.contacts[i];
    const double rate = system_.gap_rate(i);
    mode.closed = !mode.closed;
    mode.friction = Friction::none;
    if (mode.closed) mode.approach_speed = std::max(-rate, least_approach * scale_.speed());
    events.push_back({.t = state.t,
                      .kind = mode.closed ? Kind::close : Kind::open,
                      .contact = i,
                      .approach = -rate,
                      .separation = rate});
  }
}

void ContactModes::find_touching(const ContactChanges& changes) {
  touching_.clear();
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) {
    const Restitution* law = system_.model().contacts[i].restitution;
    if (!law) continue;
    const bool closed = before_.contacts[i].closed, struck = contains(changes.struck, i);
    if (!closed && !struck && system_.gap(i) > scale_.touching()) continue;
    TouchingContact c;
    c.contact = i;
    c.was_closed = closed;
    c.before = c.after = system_.gap_rate(i);
    if (struck && -c.before > treatment(i).capture_speed) c.restitution = law->coefficient(-c.before);
    touching_.push_back(c);
  }
}

double ContactModes::strike(State& state) {
  const double kinetic_before = system_.energy().kinetic;
  v_before_ = state.v;
  for (;;) {
    if (!impact_.solve(system_, scale_.at_rest(), touching_, dv_)) fail_without_solution("impact");
    state.v = v_before_ + dv_;
    if (!capture_chatter(state, state.v)) break;
    system_.move_to(state.t, state.q, v_before_);
  }
  system_.move_to(state.t, state.q, state.v);
  double elsewhere = kinetic_before - system_.energy().kinetic;
  for (const TouchingContact& c : touching_) elsewhere -= c.energy_lost();
  return elsewhere;
}

void ContactModes::fail_without_solution(const char* what) const {
  std::string names;
  bool friction = false;
  for (const TouchingContact& c : touching_) {
    const model::ContactEntry& entry = system_.model().contacts[c.contact];
    names += (names.empty() ? "" : ", ") + entry.name;
    friction = friction || entry.friction;
  }
  throw RunFailed(fmt::format(
      "the {} of contacts {} has no solution{}", what, names,
      friction ? ": with rigid contacts and this much friction there may be none (Painleve); a compliant law, such as "
                 "continuous_force, has one"
               : ""));
}

bool ContactModes::cannot_follow(double separation, double acceleration) const {
  if (!(acceleration < 0)) return false;
  if (steps_.fixed) return 2 * separation < chatter_steps_ * *steps_.fixed * -acceleration;
  const double error = steps_.tolerance.absolute + steps_.tolerance.relative * scale_.length();
  return separation * separation < chatter_steps_ * error * 2 * -acceleration;
}

// Takes e = 0 where the rebound is too short to follow; true if there is such a contact.
bool ContactModes::capture_chatter(const State& state, const Vec& v) {
  const auto rebounds = [](const TouchingContact& c) { return c.restitution > 0 && c.impulse > 0; };
  if (chatter_steps_ <= 0 || std::none_of(touching_.begin(), touching_.end(), rebounds)) return false;
  model::Modes open = modes_;
  open_all(open);
  system_.set_modes(open);
  system_.move_to(state.t, state.q, v);
  system_.accelerate({}, a_, lambda_);
  bool captured = false;
  for (TouchingContact& c : touching_)
    if (rebounds(c) && cannot_follow(c.after, system_.acceleration({c.contact, 0}, a_)))
      c.restitution = 0, captured = true;
  system_.set_modes(before_);
  return captured;
}

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
    if (now.contacts[i].closed && system_.model().contacts[i].restitution)
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

double ContactModes::step_limit(const State& state) {
  std::vector<model::ContactDirection> directions;
  const auto& contacts = system_.modes().contacts;
  for (int i = 0; i < int(contacts.size()); ++i)
    if (contacts[i].closed && contacts[i].friction != Friction::none)
      directions.push_back({i, 0}), directions.push_back({i, 1});
  if (directions.empty()) return std::numeric_limits<double>::infinity();
  system_.move_to(state.t, state.q, state.v);
  return 2 * std::numbers::pi / 3 / system_.highest_frequency(directions);
}

double ContactModes::friction_noise(int contact) {
  Mat jump, delassus;
  system_.impulse_response({{contact, 1}}, jump, delassus);
  return delassus(0, 0) > 0 ? scale_.no_acceleration() / delassus(0, 0) : 0;
}

void ContactModes::finish(State& state, bool carry) {
  system_.set_modes(modes_);
  system_.move_to(state.t, state.q, state.v);
  if (!carry) return system_.accelerate({}, state.a, state.lambda);
  const int joint_rows = system_.model().sizes.nc;
  state.lambda.setZero(system_.sizes().nc);
  if (lambda_before_.size() >= joint_rows) state.lambda.head(joint_rows) = lambda_before_.head(joint_rows);
  for (int i = 0; i < int(rows_before_.size()); ++i)
    for (const auto& [row, before] :
         {std::pair{system_.contact_row(i), rows_before_[i]}, std::pair{system_.stick_row(i), sticks_before_[i]}})
      if (row >= 0 && before >= 0 && before < lambda_before_.size()) state.lambda[row] = lambda_before_[before];
}

void ContactModes::tell_normal(const State& state, const TouchingContact& c, std::vector<ContactEvent>& events) {
  const bool closed = modes_.contacts[c.contact].closed;
  ContactEvent event{.t = state.t, .contact = c.contact, .approach = -c.before, .separation = c.after};
  if (closed != c.was_closed) {
    event.kind = closed ? Kind::close : Kind::open;
  } else if (!closed && contains(candidates_, c.contact) && c.impulse > 0) {
    event.kind = Kind::lift;
  } else {
    return;
  }
  events.push_back(event);
}

void ContactModes::tell_friction(const State& state, std::vector<ContactEvent>& events) {
  for (int i = 0; i < int(modes_.contacts.size()); ++i) {
    const model::ContactMode &now = modes_.contacts[i], &before = before_.contacts[i];
    if (!now.closed || now.friction == Friction::none) continue;
    const bool sticks = now.friction == Friction::stick;
    const bool same = before.closed && now.friction == before.friction && (sticks || now.direction == before.direction);
    if (same) continue;
    const bool slid = before.closed && before.friction == Friction::slide;
    events.push_back({.t = state.t,
                      .kind = sticks ? Kind::stick
                              : slid ? Kind::reversal
                                     : Kind::slip,
                      .contact = i,
                      .friction = system_.friction_force(i, state.lambda),
                      .direction = sticks ? 0 : now.direction});
  }
}

}  // namespace trammel::simulate
