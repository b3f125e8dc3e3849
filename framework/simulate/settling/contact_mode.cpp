#include "simulate/settling/contact_mode.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

namespace {

// Below this part of the scene's speed a contact begins at rest: it has no approach speed, and a damping law that
// scales with 1/approach_speed gives no damping. (Otherwise 1/speed would hold it with an unbounded viscosity, which
// fixed steps cannot follow.)
constexpr double least_approach = 1e-6;
// Of the shortest period of swings: the longest step (see step_limit).
constexpr double part_of_period = 0.45;

// Only friction makes forces grow beyond all bounds: without it an impact without collision changes nothing.
bool any_friction(const std::vector<Participant>& who) {
  return std::any_of(who.begin(), who.end(),
                     [](const Participant& p) { return p.tangent != Participant::Tangent::none; });
}

}  // namespace

bool ContactModes::any_closed() const {
  for (std::size_t i = 0; i < system_.modes().contacts.size(); ++i)
    if (system_.modes().contacts[i].closed && !system_.model().contacts[i].joint) return true;
  return false;
}

bool ContactModes::any_rigid_closed() const {
  for (std::size_t i = 0; i < system_.modes().contacts.size(); ++i)
    if (system_.modes().contacts[i].closed && system_.model().contacts[i].restitution) return true;
  return false;
}

void ContactModes::settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events) {
  begin(state);
  toggle(state, changes.toggled, events);
  find_touching(changes);
  find_bearings();
  const bool jumped = !changes.struck.empty() && any_approaches();
  if (jumped) {
    const auto impact = strike(state, changes);
    if (impact.outcome != LcpOutcome::solved) fail_without_impact(state.t, impact);
  }
  lock(state, changes, events);
  auto solution = decision_.decide(state, changes, jumped);
  const bool without_collision = solution.outcome == LcpOutcome::no_solution &&
                                 (changes.locked || any_friction(decision_.instant().problem().who));
  if (without_collision) solution = strike_without_collision(state, changes, jumped, events);
  if (solution.outcome != LcpOutcome::solved) fail_without_balance(state.t, solution);
  take_approach_speeds(changes);
  append_impacts(state.t, without_collision, events);
  finish(state, carries_forces(changes) && state.a.size() == system_.sizes().nv);  // the start has no a yet
  for (const TouchingContact& c : at_.touching) append_normal_event(state, c, events);
  append_friction_events(state, events);
}

void ContactModes::begin(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  at_.before = at_.modes = system_.modes();
  at_.shared_before.resize(system_.model().contacts.size());
  for (std::size_t i = 0; i < at_.shared_before.size(); ++i) at_.shared_before[i] = system_.sharing(int(i)).shared;
  keep_forces(state);
  losses_.clear();
  lost_elsewhere_ = 0;
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

bool ContactModes::carries_forces(const ContactChanges& changes) const {
  return std::any_of(at_.touching.begin(), at_.touching.end(), [&](const TouchingContact& c) {
    return (contains(changes.struck, c.contact) || contains(changes.released, c.contact)) &&
           scene_.treatment(c.contact).restart == Restitution::Restart::carry;
  });
}

void ContactModes::append_impacts(double t, bool without_collision, std::vector<ContactEvent>& events) const {
  for (const TouchingContact& c : at_.touching)
    if (c.impulse > 0 && (!c.was_closed || without_collision))
      events.push_back({.t = t,
                        .contact = c.contact,
                        .impulse = c.impulse,
                        .approach = -c.before,
                        .separation = c.after,
                        .energy_lost = c.energy_lost(),
                        .friction = system_.along_tangents(c.contact, c.friction)});
  for (const TouchingContact& c : at_.bearings)
    if (!c.friction.isZero(0))
      events.push_back({.t = t,
                        .contact = c.contact,
                        .impulse = c.impulse,
                        .energy_lost = c.energy_lost(),
                        .friction = system_.along_tangents(c.contact, c.friction)});
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

// Sets up problem_ with the closed contacts in their present modes.
void ContactModes::prepare_present(const State& state) {
  system_.move_to(state.t, state.q, state.v);
  at_.before = at_.modes = system_.modes();
  at_.shared_before.assign(at_.modes.contacts.size(), false);
  candidates_.clear();
  for (int i = 0; i < int(at_.modes.contacts.size()); ++i)
    if (at_.modes.contacts[i].closed && system_.model().contacts[i].restitution && !scene_.locks(i))
      candidates_.push_back(i);
  const ContactChanges none;
  problem_.who = participants_.gather(candidates_, {state, none, false});
  at_.modes = at_.before;
  for (Participant& p : problem_.who) p.idle = system_.sharing(p.contact).idle;
  problem_.prepare(system_);
}

double ContactModes::distance_from_critical(const State& state) {
  prepare_present(state);
  return problem_.distance_from_critical(at_.before);
}

bool ContactModes::renew_bases(State& state) {
  prepare_present(state);
  const std::vector<bool> held = problem_.held_by_others(at_.modes);
  for (std::size_t i = 0; i < held.size(); ++i)
    if (problem_.who[i].idle && !held[i]) return false;
  at_.modes.shared = problem_.shared_rows(at_.modes);
  if (implied_rows(at_.modes) < implied_rows(at_.before)) return false;
  finish(state, false);
  return true;
}

double ContactModes::step_limit(const State& state) {
  std::vector<model::ContactDirection> directions;
  const auto& contacts = system_.modes().contacts;
  for (int i = 0; i < int(contacts.size()); ++i)
    if (contacts[i].closed && contacts[i].friction != Friction::none)
      for (int row = 0; row <= system_.tangents(i); ++row) directions.push_back({i, row});
  if (directions.empty()) return std::numeric_limits<double>::infinity();
  system_.move_to(state.t, state.q, state.v);
  return part_of_period * 2 * std::numbers::pi / system_.highest_frequency(directions);
}

double ContactModes::friction_noise(int contact) {
  std::vector<model::ContactDirection> along;
  for (int k = 1; k <= system_.tangents(contact); ++k) along.push_back({contact, k});
  Mat jump, delassus;
  system_.impulse_response(along, jump, delassus);
  const double least = delassus.diagonal().minCoeff();
  return least > 0 ? scene_.scale.of(contact).no_acceleration() / least : 0;
}

double ContactModes::force_noise(const std::vector<model::ContactDirection>& directions) {
  Mat jump, delassus;
  system_.impulse_response(directions, jump, delassus);
  const double most = delassus.cwiseAbs().rowwise().sum().maxCoeff();
  double nothing = 0;
  for (const model::ContactDirection& d : directions)
    nothing = std::max(nothing, scene_.scale.of(d.contact).no_acceleration());
  return most > 0 ? nothing / most : 0;
}

// Stores the forces for contacts with `restart: carry`.
void ContactModes::keep_forces(const State& state) {
  lambda_before_ = state.lambda;
  forces_before_.clear();
  const auto carries = [this](const model::ContactEntry& contact) {
    return contact.restitution && contact.restitution->treatment().restart == Restitution::Restart::carry;
  };
  const auto& contacts = system_.model().contacts;
  if (std::none_of(contacts.begin(), contacts.end(), carries)) return;
  forces_before_.assign(contacts.size(), Eigen::Vector3d::Zero());
  if (state.lambda.size() != system_.sizes().nc) return;  // the start has no lambda yet
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const model::ContactMode& mode = at_.before.contacts[i];
    if (!mode.closed) continue;
    if (contacts[i].restitution) forces_before_[i][0] = system_.normal_force(int(i), state.lambda);
    if (mode.friction == Friction::stick) forces_before_[i].tail<2>() = system_.friction_force(int(i), state.lambda);
  }
}

// Sets multipliers that stand for the stored forces; for rows that depend on each other, for their resultants.
void ContactModes::carry_forces(Vec& lambda) const {
  const int joint_rows = system_.model().sizes.nc;
  lambda.setZero(system_.sizes().nc);
  if (lambda_before_.size() >= joint_rows) lambda.head(joint_rows) = lambda_before_.head(joint_rows);
  const auto force = [this](const model::ContactDirection& d) { return forces_before_[std::size_t(d.contact)][d.row]; };
  for (int i = 0; i < int(forces_before_.size()); ++i)
    for (int k = 0; k < 3; ++k)
      if (const int row = system_.row({i, k}); row >= 0) lambda[row] = -force({i, k});
  for (const model::SharedRows& shared : system_.modes().shared)
    for (std::size_t j = 0; j < shared.basis.size(); ++j)
      for (std::size_t i = 0; i < shared.implied.size(); ++i)
        lambda[system_.row(shared.basis[j])] -= shared.K(Eigen::Index(i), Eigen::Index(j)) * force(shared.implied[i]);
}

void ContactModes::finish(State& state, bool carry) {
  system_.set_modes(at_.modes);
  system_.move_to(state.t, state.q, state.v);
  if (carry)
    carry_forces(state.lambda);
  else
    system_.accelerate({}, state.a, state.lambda);
}

void ContactModes::append_normal_event(const State& state, const TouchingContact& c,
                                       std::vector<ContactEvent>& events) {
  const bool closed = at_.modes.contacts[c.contact].closed;
  ContactEvent event{.t = state.t, .contact = c.contact, .approach = -c.before, .separation = c.after};
  if (closed != c.was_closed) {
    event.kind = closed ? Kind::close : Kind::open;
  } else if (!closed && contains(decision_.instant().candidates(), c.contact) && c.impulse > 0) {
    event.kind = Kind::lift;
  } else {
    return;
  }
  events.push_back(event);
}

void ContactModes::append_friction_events(const State& state, std::vector<ContactEvent>& events) {
  for (int i = 0; i < int(at_.modes.contacts.size()); ++i) {
    const model::ContactMode &now = at_.modes.contacts[i], &before = at_.before.contacts[i];
    if (!now.closed || now.friction == Friction::none) continue;
    const bool sticks = now.friction == Friction::stick;
    const bool same =
        before.closed && now.friction == before.friction && (sticks || now.direction.dot(before.direction) > 0);
    if (same) continue;
    const bool slid = before.closed && before.friction == Friction::slide;
    events.push_back({.t = state.t,
                      .kind = sticks ? Kind::stick
                              : slid ? Kind::reversal
                                     : Kind::slip,
                      .contact = i,
                      .friction = system_.along_tangents(i, system_.friction_force(i, state.lambda)),
                      .direction = system_.along_tangents(i, now.direction)});
  }
}

}  // namespace trammel::simulate
