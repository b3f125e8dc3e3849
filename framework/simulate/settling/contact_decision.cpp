// Rules 3 to 7 and 11 of contact_mode.hpp: which contacts close, open, stick and slide, by the complementarity problem.
#include <algorithm>
#include <cmath>

#include "simulate/settling/contact_mode.hpp"
#include "simulate/verdicts/errors_of_solutions.hpp"
#include "simulate/verdicts/groups.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;

namespace {

using Tangent = Participant::Tangent;

// For the state a moment later they can be. Parts of the time in which the scene crosses its length, at its speed or by
// its accelerations, or in which a slip ends; little else has changed by then. Each is tried if those before it leave
// the modes in doubt.
constexpr double moments_later[] = {1e-4, 1e-3, 1e-2};

// Relative to the rates before an impact in its island: what it leaves in the rates that it ends.
constexpr double error_of_impacts = 1e-9;
// Relative to the largest force in the island: what is left, or lacks, of a force at the instant found for its end.
constexpr double error_of_release = 1e-10;
// Of `least_slip`: a smaller slip left in a contact at rest turns its friction by no more (system/point/slip.hpp) when
// it begins to slide.
constexpr double no_turn = 1e-9;
// Of the speed that a fixed step changes: less is not resolved by such steps.
constexpr double part_of_step = 0.1;

}  // namespace

void ContactModes::open_all(model::Modes& modes) const {
  for (const TouchingContact& c : at_.touching)
    modes.contacts[c.contact].closed = false, modes.contacts[c.contact].friction = Friction::none;
  for (std::size_t i = 0; i < modes.contacts.size(); ++i)
    if (system_.model().contacts[i].joint)
      modes.contacts[i].closed = false, modes.contacts[i].friction = Friction::none;
  modes.shared.clear();
}

// [m/s] Round-off that the impact leaves in the rates of this contact: of the rates before it in its island.
double ContactModes::error_of_impact(int contact) const {
  double scale = 0;
  for (const TouchingContact& c : at_.touching)
    if (scene_.scale.island(c.contact) == scene_.scale.island(contact))
      scale = std::max({scale, std::abs(c.before), c.slip_before.norm()});
  return error_of_impacts * scale;
}

void ContactModes::find_candidates(const ContactChanges& changes) {
  candidates_.clear();
  for (const TouchingContact& c : at_.touching) {
    const double rest_speed = error_of_impact(c.contact) + scene_.scale.of(c.contact).rest_speed();
    const bool constrained = c.impulse > 0 && scene_.treatment(c.contact).rebound == Restitution::Rebound::constrained;
    // A closed contact may have kept the rate that the steps left in it, or have lost it with others (rule 2).
    const bool rests = std::abs(c.after) <= rest_speed || (c.was_closed && std::abs(c.after - c.before) <= rest_speed);
    const bool released = contains(changes.released, c.contact) && c.impulse == 0 && !at_.shared_before[c.contact];
    if ((rests || constrained) && !released) candidates_.push_back(c.contact);
  }
}

// [m/s] Slip across its former direction that counts as none; with fixed steps also what a part of a step takes away.
double ContactModes::unresolved(int contact, const State& state) {
  const model::ContactMode& mode = at_.before.contacts[contact];
  if (!scene_.steps.fixed || system_.tangents(contact) == 1) return mode.least_slip;
  const double in_a_step = *scene_.steps.fixed * system_.slip_acceleration(contact, state.a).norm();
  return std::max(mode.least_slip, part_of_step * in_a_step);
}

double ContactModes::least_acceleration(int contact) const {
  const double largest = at_.largest.empty() ? 0 : at_.largest[std::size_t(contact)];
  return std::max(scene_.scale.of(contact).no_acceleration(), error_of_accelerations * largest);
}

// Rule 5: whether the contact is at rest in the tangent, and its coefficients.
void ContactModes::add_friction(const State& state, Participant& p, const ContactChanges& changes, bool jumped) {
  const model::ContactEntry& entry = system_.model().contacts[p.contact];
  if (!entry.friction) return;
  const Tangential slip = system_.slip(p.contact);
  const double speed = slip.norm();
  if (entry.smooth) {
    p.tangent = Tangent::sliding;
    if (speed > 0) p.ratio = -entry.smooth->ratio(speed) * direction_of(slip);
    return;
  }
  p.mu_0 = entry.coulomb->static_coefficient();
  p.mu = entry.coulomb->kinetic_coefficient(speed);
  if (p.mu_0 == 0) return;
  const model::ContactMode& before = at_.before.contacts[p.contact];
  const bool was_closed = before.closed && before.friction != Friction::none;
  const double rest_speed = std::max(scene_.stick_speed(p.contact), jumped ? error_of_impact(p.contact) : 0);
  bool rests = speed <= rest_speed;
  Tangential unit = direction_of(slip);
  p.direction = unit;
  if (was_closed && !jumped) {
    const model::SlipDirection goes(slip, before.direction, before.least_slip);
    const bool stopped = contains(changes.stopped, p.contact);
    rests = before.friction == Friction::stick || (stopped && std::abs(goes.across()) <= unresolved(p.contact, state));
    if (!stopped) {
      unit = goes.unit();
      // A slower slip keeps turning from the direction that it had (system/point/slip.hpp).
      p.direction = goes.along() > before.least_slip ? unit : before.direction;
    }
  }
  p.tangent = rests ? Tangent::resting : Tangent::sliding;
  if (!rests) p.ratio = -p.mu * unit;
  p.let_go = p.yielded = rests && !at_.shared_before[p.contact] && contains(changes.yielded, p.contact) &&
                         entry.coulomb->decide() == SetValuedFriction::Decide::at_events;
}

// Participants: candidates of rule 3, then joints with friction and compliant contacts at rest in the tangent.
void ContactModes::gather(const State& state, const ContactChanges& changes, bool jumped) {
  problem_.who.clear();
  for (const int i : candidates_) {
    Participant p{.contact = i};
    add_friction(state, p, changes, jumped);
    problem_.who.push_back(p);
  }
  for (int i = 0; i < int(at_.modes.contacts.size()); ++i) {
    const model::ContactEntry& entry = system_.model().contacts[i];
    if (entry.joint) {
      Participant p{.contact = i, .unilateral = false, .given_pushes = true};
      add_friction(state, p, changes, jumped);
      problem_.who.push_back(p);
    } else if (entry.force && entry.coulomb && at_.modes.contacts[i].closed) {
      gather_compliant(i, state, changes, jumped);
    }
  }
}

// One that slides takes no part: its friction is known.
void ContactModes::gather_compliant(int contact, const State& state, const ContactChanges& changes, bool jumped) {
  Participant p{.contact = contact, .unilateral = false};
  add_friction(state, p, changes, jumped);
  model::ContactMode& mode = at_.modes.contacts[contact];
  mode.friction = p.tangent == Tangent::sliding ? Friction::slide : Friction::none;
  mode.direction = p.direction;
  mode.least_slip = scene_.least_slip(contact);
  if (p.tangent == Tangent::resting) problem_.who.push_back(p);
}

// Rule 7: adds to changes.stopped the sliding contacts whose slip follows from the rates of the contacts at rest and of
// the closed rows. True if there are any. Steps leave small rates in rows, so the slips of the feet of one block do not
// reach 0 at one instant. A slip that does not follow from these rates is a motion, however slow: in a row of dominoes
// each moves the one behind it by half as much. In space, contacts whose slip is too slow to have a direction are added
// too: a body that slides and spins ends both at once.
bool ContactModes::stop_with_others(ContactChanges& changes) {
  if (changes.stopped.empty()) return false;
  const std::vector<double> independent = problem_.independent_slip(problem_.rates(system_));
  // Joints' rows have drifts of their own, from which a slip may follow.
  const bool joints = system_.model().sizes.nc > 0;
  const std::size_t before = changes.stopped.size();
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const int contact = problem_.who[i].contact;
    const model::ContactMode& slid = at_.before.contacts[contact];
    if (problem_.who[i].tangent != Tangent::sliding || !slid.closed || contains(changes.stopped, contact)) continue;
    if (!system_.model().contacts[contact].coulomb) continue;
    const double speed = system_.slip(contact).norm();
    const Scale scale = scene_.scale.of(contact);
    const bool held = independent[i] <= (joints ? scale.drift() : scale.rest_speed());
    if (speed < slid.least_slip || (held && speed <= scale.drift())) changes.stopped.push_back(contact);
  }
  return changes.stopped.size() > before;
}

// Rule 7: ends the drift of the contacts at rest. True if this has ended the slip of sliding contacts too; they are
// added to changes.stopped.
bool ContactModes::end_drift(State& state, ContactChanges& changes, bool jumped) {
  bool drifted = false, turns = false;
  for (Participant& p : problem_.who) {
    if (p.tangent != Tangent::resting) continue;
    p.a_t = system_.slip(p.contact);
    const double drift = p.a_t.norm(), least = scene_.least_slip(p.contact);  // 0 in the plane, where no slip turns
    drifted = drifted || drift > scene_.stick_speed(p.contact);
    turns = turns || (least > 0 && drift > no_turn * least);
  }
  if (!drifted && !turns) return false;
  problem_.end_slip(dv_);
  state.v += dv_;
  system_.move_to(state.t, state.q, state.v);
  for (Participant& p : problem_.who)  // slow slips have turned
    if (p.tangent == Tangent::sliding) add_friction(state, p, changes, jumped);
  if (!drifted) return false;
  bool more = false;
  for (int i = 0; i < int(at_.before.contacts.size()); ++i) {
    if (!at_.before.contacts[i].closed || at_.before.contacts[i].friction != Friction::slide) continue;
    if (contains(changes.stopped, i) || system_.slip(i).norm() > scene_.scale.of(i).rest_speed()) continue;
    changes.stopped.push_back(i);
    more = true;
  }
  return more;
}

// Rules 3 to 7, and 10 and 12 to 15 with them.
complementarity::ContactSolution ContactModes::decide(State& state, ContactChanges changes, bool jumped,
                                                      const std::vector<Participant>& nearby) {
  bearings_undecided_ = false;
  by_forces_.restart();
  at_.largest.assign(at_.modes.contacts.size(), 0);  // values of an earlier event would be unknown to a resumed run
  do {
    gather(state, changes, jumped);
    open_all(at_.modes);
    if (problem_.who.empty()) return {LcpOutcome::solved, 0};
    problem_.prepare(system_);
  } while (stop_with_others(changes) || end_drift(state, changes, jumped));
  for (std::vector<Participant> begin = nearby;;) {
    system_.set_modes(at_.modes);
    system_.move_to(state.t, state.q, state.v);
    accelerate_participants();
    if (has_bearings()) return decide_with_bearings(state);
    const complementarity::ContactSolution solution = by_forces_.solve(state, begin);
    if (solution.outcome != LcpOutcome::solved) return solution;
    if (by_forces_.share_within_bounds(state)) return solution;
    if (by_forces_.bounded_by_springs()) begin = problem_.who;
    open_all(at_.modes);
  }
}

// Rule 11. By participant: in its island the error of the solution, or of the instant at which a force fell to 0,
// leaves open which contacts press. What is left of that force may have passed to another contact.
std::vector<bool> ContactModes::in_doubt(const std::vector<int>& released) const {
  if (problem_.who.empty()) return {};
  const auto loses_a_force = [&](int contact) {
    return std::any_of(released.begin(), released.end(),
                       [&](int other) { return scene_.scale.island(other) == scene_.scale.island(contact); });
  };
  const std::vector<double> largest = problem_.largest_in_island();
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> open(problem_.who.size(), false), all;  // by island
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const Participant& p = problem_.who[i];
    const bool opens = at_.before.contacts[p.contact].closed && !at_.modes.contacts[p.contact].closed;
    const double error = loses_a_force(p.contact) ? std::max(p.violation, error_of_release) : p.violation;
    const bool just_presses =
        p.N > 0 && (p.N <= undecided * error * largest[i] || by_forces_.verdicts().would_hardly_close(i));
    if (p.unilateral && (just_presses || (opens && p.a_n <= by_forces_.verdicts().least_acceleration(p))))
      open[island[i]] = true;
  }
  for (const std::size_t k : island) all.push_back(open[k]);
  return all;
}

// [s] The time in which the contacts asked cross the length of their scene, or in which a slip ends if this is shorter.
// At the system's point; a_ are the accelerations there.
double ContactModes::time_of_change(const std::vector<bool>& asked) {
  double length = 0, speed = 0, largest = 0;
  const auto is_asked = [&](const Participant& p) { return asked[std::size_t(p.contact)]; };
  for (const Participant& p : problem_.who) {
    if (!is_asked(p)) continue;
    const Scale scale = scene_.scale.of(p.contact);
    length = std::max(length, scale.length()), speed = std::max(speed, scale.speed);
    largest = std::max(largest, at_.largest[std::size_t(p.contact)]);
  }
  speed = std::max(speed, std::sqrt(largest * length));
  double least = speed > 0 ? length / speed : 0;
  for (const Participant& p : problem_.who) {
    if (p.tangent != Tangent::sliding || !is_asked(p)) continue;
    const Tangential slip = system_.slip(p.contact), change = system_.slip_acceleration(p.contact, a_);
    if (!(slip.dot(change) < 0)) continue;  // it does not slow down
    const double slips = slip.norm();
    if (slips > scene_.scale.of(p.contact).rest_speed() && slips < least * change.norm()) least = slips / change.norm();
  }
  return least;
}

// Rule 11. Adds to the contacts asked all that share an island with one of them now: one that was released may press
// again.
std::vector<bool> ContactModes::with_their_islands(std::vector<bool> asked) const {
  if (problem_.who.empty()) return asked;
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> of_island(island.size(), false);
  for (std::size_t i = 0; i < island.size(); ++i)
    if (asked[std::size_t(problem_.who[i].contact)]) of_island[island[i]] = true;
  for (std::size_t i = 0; i < island.size(); ++i)
    if (of_island[island[i]]) asked[std::size_t(problem_.who[i].contact)] = true;
  return asked;
}

// Rule 11: decides by the state a moment later. `asked`: contacts whose modes are in doubt. `so_far`: the solution of
// this instant, which stays if no later state decides.
complementarity::ContactSolution ContactModes::decide_by_what_follows(const State& state, ContactChanges changes,
                                                                      bool jumped, const std::vector<bool>& asked,
                                                                      complementarity::ContactSolution so_far) {
  const model::Modes decided = at_.modes;
  const std::vector<Participant> now = so_far.outcome == LcpOutcome::solved ? problem_.who : std::vector<Participant>();
  system_.set_modes(so_far.outcome == LcpOutcome::solved ? at_.modes : at_.before);
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  const double time = time_of_change(asked);
  const Vec a = a_;
  changes.released.clear();
  for (const double part : moments_later) {
    const double moment = part * time;
    State later = state;
    later.t += moment;
    system_.retract(state.q, moment * state.v + 0.5 * moment * moment * a, later.q);
    later.v += moment * a;
    system_.move_to(later.t, later.q, later.v);
    find_candidates(changes);
    const complementarity::ContactSolution solution = decide(later, changes, jumped, now);
    system_.move_to(state.t, state.q, state.v);
    if (solution.outcome == LcpOutcome::solved) keep_others(decided, with_their_islands(asked), at_.modes);
    if (solution.outcome != LcpOutcome::gave_up) return solution;
  }
  at_.modes = decided;
  return so_far;
}

// Accelerations of the participants without the forces sought, and the given normal forces.
void ContactModes::accelerate_participants() {
  system_.accelerate({}, a_, lambda_);
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<double> largest(island.size(), 0), least(island.size(), 0);  // by island
  for (std::size_t i = 0; i < island.size(); ++i) {
    Participant& p = problem_.who[i];
    if (!p.unilateral) p.given = system_.normal_force(p.contact, lambda_);
    p.least_slip = scene_.scale.of(p.contact).no_acceleration();
    p.a_n = system_.acceleration({p.contact, 0}, a_);
    if (p.tangent != Tangent::none) p.a_t = system_.slip_acceleration(p.contact, a_);
    largest[island[i]] = std::max({largest[island[i]], std::abs(p.a_n), p.a_t.norm()});
    least[island[i]] = std::max(least[island[i]], p.least_slip);
  }
  at_.largest.assign(at_.modes.contacts.size(), 0);
  for (std::size_t i = 0; i < island.size(); ++i) {
    Participant& p = problem_.who[i];
    at_.largest[std::size_t(p.contact)] = largest[island[i]];
    p.nothing = std::max(least[island[i]], error_of_accelerations * largest[island[i]]);
  }
}

}  // namespace trammel::simulate
