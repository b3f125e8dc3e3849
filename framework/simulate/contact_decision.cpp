// Rules 3 to 7 and 11 to 13 of contact_mode.hpp: which contacts close, open, stick and slide, by the complementarity
// problem.
#include <algorithm>
#include <cmath>

#include "complementarity/exact_modes.hpp"
#include "simulate/contact/law_speeds.hpp"
#include "simulate/contact_mode.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

using Tangent = Participant::Tangent;

// Rule 11. Forces and accelerations below `undecided` times the error of a solution cannot be distinguished from 0.
// They can be for the state a moment later: after a part of the time in which the scene crosses its length, at
// its speed or by its accelerations, or in which a slip ends. Little else has changed by then.
constexpr double undecided = 10;
// A later state is asked if an earlier one leaves it open, too.
constexpr double moments_later[] = {1e-4, 1e-3, 1e-2};

// Of the largest force. Contacts with less force may be idle.
constexpr double most_error_of_forces = 1e-6;

// x / |x|; the direction of the first tangent if x is 0.
Tangential direction_of(const Tangential& x) {
  const double length = x.norm();
  return length > 0 ? Tangential(x / length) : Tangential(1, 0);
}

bool has_sliding(const model::SharedRows& group) {
  return !group.sliding.empty();
}

bool shares_tangents(const model::SharedRows& group, int contact) {
  const auto is = [contact](const model::ContactDirection& d) { return d.contact == contact && d.row > 0; };
  return std::any_of(group.basis.begin(), group.basis.end(), is) ||
         std::any_of(group.implied.begin(), group.implied.end(), is);
}

bool has_any(const std::vector<bool>& all) {
  return std::find(all.begin(), all.end(), true) != all.end();
}

// Rule 12. Contacts held at their bounds let go where mu < mu_0. True if any does: all modes are to be decided again.
bool let_go(const std::vector<Participant*>& held) {
  bool again = false;
  for (Participant* p : held)
    if (!p->let_go && p->mu < p->mu_0) p->let_go = again = true;
  return again;
}

}  // namespace

void ContactModes::open_all(model::Modes& modes) const {
  for (const TouchingContact& c : touching_)
    modes.contacts[c.contact].closed = false, modes.contacts[c.contact].friction = Friction::none;
  for (std::size_t i = 0; i < modes.contacts.size(); ++i)
    if (system_.model().contacts[i].joint)
      modes.contacts[i].closed = false, modes.contacts[i].friction = Friction::none;
  modes.shared.clear();
}

// [m/s] Round-off that the impact leaves in the rates of this contact: of the rates before it in its island.
double ContactModes::error_of_impact(int contact) const {
  double scale = 0;
  for (const TouchingContact& c : touching_)
    if (scale_.island(c.contact) == scale_.island(contact))
      scale = std::max({scale, std::abs(c.before), c.slip_before.norm()});
  return 1e-9 * scale;
}

void ContactModes::find_candidates(const ContactChanges& changes) {
  candidates_.clear();
  for (const TouchingContact& c : touching_) {
    const double rest_speed = error_of_impact(c.contact) + scale_.of(c.contact).rest_speed();
    const bool constrained = c.impulse > 0 && treatment(c.contact).rebound == Restitution::Rebound::constrained;
    // A closed contact may have kept the rate that the steps left in it, or have lost it with others (rule 2).
    const bool rests = std::abs(c.after) <= rest_speed || (c.was_closed && std::abs(c.after - c.before) <= rest_speed);
    const bool released = contains(changes.released, c.contact) && c.impulse == 0 && !shared_before_[c.contact];
    if ((rests || constrained) && !released) candidates_.push_back(c.contact);
  }
}

double ContactModes::least_slip(int contact) const {
  return system_.model().world.space == Space::spatial ? scale_.of(contact).least_speed() : 0;
}

double ContactModes::stick_speed(int contact) const {
  return simulate::stick_speed(system_.model().contacts[contact], scale_.of(contact));
}

// [m/s] Slip across its former direction that counts as none; with fixed steps also what a tenth of a step takes away.
double ContactModes::unresolved(int contact, const State& state) {
  const model::ContactMode& mode = before_.contacts[contact];
  if (!steps_.fixed || system_.tangents(contact) == 1) return mode.least_slip;
  return std::max(mode.least_slip, 0.1 * *steps_.fixed * system_.slip_acceleration(contact, state.a).norm());
}

double ContactModes::least_acceleration(int contact) const {
  const double largest = largest_.empty() ? 0 : largest_[std::size_t(contact)];
  return std::max(scale_.of(contact).no_acceleration(), 1e-12 * largest);
}

// Of a solution with the violation found.
double ContactModes::least_acceleration(const Participant& p) const {
  return std::max(p.nothing, undecided * p.violation * largest_[std::size_t(p.contact)]);
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
  const model::ContactMode& before = before_.contacts[p.contact];
  const bool was_closed = before.closed && before.friction != Friction::none;
  const double rest_speed = std::max(stick_speed(p.contact), jumped ? error_of_impact(p.contact) : 0);
  bool rests = speed <= rest_speed;
  p.direction = direction_of(slip);
  if (was_closed && !jumped) {
    const model::SlipDirection goes(slip, before.direction, before.least_slip);
    const bool stopped = contains(changes.stopped, p.contact);
    rests = before.friction == Friction::stick || (stopped && std::abs(goes.across()) <= unresolved(p.contact, state));
    if (!stopped) p.direction = goes.unit();
  }
  p.tangent = rests ? Tangent::resting : Tangent::sliding;
  if (!rests) p.ratio = -p.mu * p.direction;
  p.let_go = p.yielded = rests && !shared_before_[p.contact] && contains(changes.yielded, p.contact) &&
                         entry.coulomb->decide() == SetValuedFriction::Decide::at_events;
}

// Participants: candidates of rule 3, joints with friction, and compliant contacts at rest in the tangent.
void ContactModes::gather(const State& state, const ContactChanges& changes, bool jumped) {
  problem_.who.clear();
  for (const int i : candidates_) {
    Participant p;
    p.contact = i;
    add_friction(state, p, changes, jumped);
    problem_.who.push_back(p);
  }
  for (int i = 0; i < int(modes_.contacts.size()); ++i) {
    if (system_.model().contacts[i].joint) {
      Participant p;
      p.contact = i;
      p.unilateral = false;
      p.given_pushes = true;
      add_friction(state, p, changes, jumped);
      problem_.who.push_back(p);
      continue;
    }
    model::ContactMode& mode = modes_.contacts[i];
    if (!mode.closed || !system_.model().contacts[i].force || !system_.model().contacts[i].coulomb) continue;
    Participant p;
    p.contact = i;
    p.unilateral = false;
    add_friction(state, p, changes, jumped);
    mode.friction = p.tangent == Tangent::sliding ? Friction::slide : Friction::none;
    mode.direction = p.direction;
    mode.least_slip = least_slip(i);
    if (p.tangent == Tangent::resting) problem_.who.push_back(p);
  }
}

// Rule 7: adds to changes.stopped the sliding contacts to which those at rest, and the closed rows, leave no slip; true
// if there are any. Steps leave small slips in them, so the slips of, for example, the feet of one block do not reach 0
// at one instant. A slip that does not follow from the small rates left elsewhere is a motion, however slow: in a row
// of dominoes each moves the one behind it by half as much. In space, contacts whose slip is too slow to have a
// direction are added too: a body that slides and spins ends both at once.
bool ContactModes::stop_with_others(ContactChanges& changes) {
  if (changes.stopped.empty()) return false;
  const std::vector<double> beside = problem_.slip_beside_others(problem_.rates(system_));
  // Joints' rows have drifts of their own, from which a slip may follow.
  const bool joints = system_.model().sizes.nc > 0;
  const std::size_t before = changes.stopped.size();
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const int contact = problem_.who[i].contact;
    const model::ContactMode& slid = before_.contacts[contact];
    if (problem_.who[i].tangent != Tangent::sliding || !slid.closed || contains(changes.stopped, contact)) continue;
    if (!system_.model().contacts[contact].coulomb) continue;
    const double speed = system_.slip(contact).norm();
    const Scale scale = scale_.of(contact);
    const bool held = beside[i] <= (joints ? scale.drift() : scale.rest_speed());
    if (speed < slid.least_slip || (held && speed <= scale.drift())) changes.stopped.push_back(contact);
  }
  return changes.stopped.size() > before;
}

// Rule 7: ends the drift of the contacts at rest. True if this has ended the slip of sliding contacts too; they are
// added to changes.stopped.
bool ContactModes::end_drift(State& state, ContactChanges& changes) {
  bool drifted = false;
  for (Participant& p : problem_.who) {
    if (p.tangent != Tangent::resting) continue;
    p.a_t = system_.slip(p.contact);
    const double drift = p.a_t.norm();
    drifted = drifted || drift > stick_speed(p.contact);
  }
  if (!drifted) return false;
  problem_.end_slip(dv_);
  state.v += dv_;
  system_.move_to(state.t, state.q, state.v);
  bool more = false;
  for (int i = 0; i < int(before_.contacts.size()); ++i) {
    if (!before_.contacts[i].closed || before_.contacts[i].friction != Friction::slide) continue;
    if (contains(changes.stopped, i) || system_.slip(i).norm() > scale_.of(i).rest_speed()) continue;
    changes.stopped.push_back(i);
    more = true;
  }
  return more;
}

// Rules 3, 5, 6 and 7.
complementarity::ContactSolution ContactModes::decide(State& state, ContactChanges changes, bool jumped) {
  bearings_undecided_ = false;
  largest_.assign(modes_.contacts.size(), 0);  // values of an earlier event would be unknown to a resumed run
  do {
    gather(state, changes, jumped);
    open_all(modes_);
    if (problem_.who.empty()) return {complementarity::LcpOutcome::solved, 0};
    problem_.prepare(system_);
  } while (stop_with_others(changes) || end_drift(state, changes));
  for (;;) {
    system_.set_modes(modes_);
    system_.move_to(state.t, state.q, state.v);
    accelerate_participants();
    if (has_bearings()) return decide_with_bearings(state);
    const complementarity::ContactSolution solution = take_verdicts(state);
    if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
    const std::vector<Participant*> held = held_at_bounds(state);
    if (!let_go(held)) return hold(state, held), solution;
    open_all(modes_);
  }
}

complementarity::ContactSolution ContactModes::take_verdicts(const State& state) {
  const complementarity::ContactSolution solution = problem_.solve();
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  std::vector<double> nothing;
  for (const Participant& p : problem_.who) nothing.push_back(least_acceleration(p));
  const std::vector<bool> kept_closed = problem_.kept_closed(nothing);
  for (std::size_t i = 0; i < problem_.who.size(); ++i) take_verdict(problem_.who[i], kept_closed[i]);
  find_shares(state);
  open_pulling_ones(state);
  return solution;
}

// Rule 13. Which contacts without a force are idle matters, because the springs' shares of the others affect the
// motion. The forces of the problem leave this open: they may be 0 by a self-stress that sliding contacts share, and
// their error is unknown where they are much larger than what accelerates (a wedge). So contacts with a little more
// force are idle too, or none is, if the forces in these modes could not be exerted otherwise. Each island is decided
// for itself: a force that is an error in one is large in another.
void ContactModes::find_shares(const State& state) {
  constexpr double round_off = complementarity::largest_violation, no_contact = -1;
  const model::Modes decided = modes_;
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<double> none(problem_.who.size(), round_off), least = share(none);
  std::vector<bool> doubtful(none.size());  // by island
  for (std::size_t k = 0; k < least.size(); ++k) doubtful[k] = least[k] <= most_error_of_forces;
  for (std::size_t i = 0; i < island.size(); ++i)
    if (problem_.who[i].idle) doubtful[island[i]] = true;
  const auto doubts_remain = [&] {
    if (!has_any(doubtful)) return false;
    const std::vector<bool> exerted = can_be_exerted(state);
    for (std::size_t k = 0; k < exerted.size(); ++k) doubtful[k] = doubtful[k] && !exerted[k];
    return has_any(doubtful);
  };
  const auto share_again = [&] {
    modes_ = decided;
    least = share(none);
  };
  while (doubts_remain()) {
    bool more = false;
    for (std::size_t k = 0; k < none.size(); ++k)
      if (doubtful[k] && least[k] <= most_error_of_forces) none[k] = least[k], more = true;
    if (!more) break;
    share_again();
  }
  const auto share_doubtful = [&](double part) {
    for (std::size_t k = 0; k < none.size(); ++k)
      if (doubtful[k]) none[k] = part;
    share_again();
  };
  if (!has_any(doubtful)) return;
  share_doubtful(no_contact);
  if (doubts_remain()) share_doubtful(round_off);
}

std::vector<double> ContactModes::share(const std::vector<double>& none) {
  const std::vector<double> least = problem_.find_idle(modes_, none);
  for (const Participant& p : problem_.who)  // without a force there is no friction
    if (model::ContactMode& mode = modes_.contacts[p.contact]; p.idle && mode.friction == Friction::stick)
      mode.friction = Friction::none;
  modes_.shared = problem_.shared_rows(modes_);
  while (open_loose_ones()) modes_.shared = problem_.shared_rows(modes_);
  return least;
}

// Rule 13. A contact without a force stays closed only as long as the others hold it.
bool ContactModes::open_loose_ones() {
  const std::vector<bool> held = problem_.held_by_others(modes_);
  bool any = false;
  for (std::size_t i = 0; i < held.size(); ++i) {
    Participant& p = problem_.who[i];
    if (!p.idle || held[i]) continue;
    model::ContactMode& mode = modes_.contacts[p.contact];
    p.idle = mode.closed = false;
    mode.friction = Friction::none;
    any = true;
  }
  return any;
}

// Rule 13. A contact whose force in the solution may be its error pulls if its row makes this force exact. It opens, if
// it parts then; the contacts of one island together.
void ContactModes::open_pulling_ones(const State& state) {
  const std::vector<double> largest = problem_.largest_beside();
  std::vector<std::size_t> faint;
  for (std::size_t i = 0; i < largest.size(); ++i)
    if (const Participant& p = problem_.who[i];
        p.unilateral && !p.idle && p.N > 0 && p.N <= most_error_of_forces * largest[i])
      faint.push_back(i);
  if (faint.empty() || !has_forces_in(modes_, state)) return;
  const model::Modes decided = modes_;
  const auto contact = [this](std::size_t i) { return problem_.who[i].contact; };
  std::erase_if(faint,
                [&](std::size_t i) { return locks(contact(i)) || !(system_.normal_force(contact(i), lambda_) < 0); });
  const std::vector<std::size_t> island = problem_.islands();
  for (std::vector<std::size_t>& opened = faint; !opened.empty();) {
    for (const std::size_t i : opened) {
      modes_.contacts[contact(i)].closed = false;
      modes_.contacts[contact(i)].friction = Friction::none;
    }
    find_shares(state);
    std::vector<bool> closes(problem_.who.size(), !has_forces_in(modes_, state));  // by island
    for (const std::size_t i : opened)
      if (!closes[island[i]] && !(system_.acceleration({contact(i), 0}, a_) >= 0)) closes[island[i]] = true;
    if (std::erase_if(opened, [&](std::size_t i) { return closes[island[i]]; }) == 0) return;
    modes_ = decided;
    if (opened.empty()) find_shares(state);
  }
}

// Sets a_ and lambda_. False if these modes have no finite forces, as where a joint locks itself: they are only tried.
bool ContactModes::has_forces_in(const model::Modes& modes, const State& state) try {
  system_.set_modes(modes);
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  return a_.allFinite() && lambda_.allFinite();
} catch (const model::LocksItself&) {
  return false;
}

// By island: whether the forces in these modes push and stay in their cones.
std::vector<bool> ContactModes::can_be_exerted(const State& state) {
  const std::vector<std::size_t> island = problem_.islands();
  if (!has_forces_in(modes_, state)) return std::vector<bool>(island.size(), false);
  std::vector<double> largest(island.size(), 0), worst(island.size(), 0);
  for (std::size_t i = 0; i < island.size(); ++i) {
    const Participant& p = problem_.who[i];
    const model::ContactMode& mode = modes_.contacts[p.contact];
    if (!mode.closed || !p.unilateral) continue;
    const double N = system_.normal_force(p.contact, lambda_);
    double& most = worst[island[i]];
    largest[island[i]] = std::max(largest[island[i]], std::abs(N));
    most = std::max(most, -N);
    if (mode.friction != Friction::stick) continue;
    const double bound = system_.model().contacts[p.contact].coulomb->static_coefficient() * std::max(0.0, N);
    most = std::max(most, system_.friction_force(p.contact, lambda_).norm() - bound);
  }
  std::vector<bool> exerted;
  for (std::size_t k = 0; k < island.size(); ++k) exerted.push_back(worst[k] <= most_error_of_forces * largest[k]);
  return exerted;
}

// Rule 12: the contacts at rest whose friction is at its bound while a group with sliding members cannot carry its
// resultant.
std::vector<Participant*> ContactModes::held_at_bounds(const State& state) {
  constexpr double reached = 1 - 1e-6, round_off = 1e-9;
  const auto at_bound = [this](const Participant& p) {
    const bool sticks = modes_.contacts[p.contact].friction == Friction::stick;
    return sticks && p.N > 0 && p.T.norm() > reached * (p.let_go ? p.mu : p.mu_0) * p.N;
  };
  const bool sliding_shares = std::any_of(modes_.shared.begin(), modes_.shared.end(), has_sliding);
  if (!sliding_shares || std::none_of(problem_.who.begin(), problem_.who.end(), at_bound)) return {};
  system_.set_modes(modes_);
  system_.move_to(state.t, state.q, state.v);
  system_.accelerate({}, a_, lambda_);
  std::vector<Participant*> held;
  for (std::size_t g = 0; g < modes_.shared.size(); ++g) {
    if (!has_sliding(modes_.shared[g])) continue;
    if (system_.spare_load(int(g), lambda_) >= -round_off * system_.largest_load(int(g), lambda_)) continue;
    for (Participant& p : problem_.who)
      if (at_bound(p) && shares_tangents(modes_.shared[g], p.contact)) held.push_back(&p);
  }
  return held;
}

// Rule 12: they keep T = mu N, as if they slid.
void ContactModes::hold(const State& state, const std::vector<Participant*>& held) {
  for (Participant* p : held) {
    model::ContactMode& mode = modes_.contacts[p->contact];
    mode.friction = Friction::slide;
    mode.direction = -direction_of(p->T);
    mode.least_slip = least_slip(p->contact);
    p->ratio = -p->mu * mode.direction;
  }
  if (!held.empty()) find_shares(state);
}

// Rule 11. By participant: the error of the solution of its island leaves open which contacts press.
std::vector<bool> ContactModes::in_balance() const {
  if (problem_.who.empty()) return {};
  const std::vector<double> largest = problem_.largest_beside();
  const std::vector<std::size_t> island = problem_.islands();
  std::vector<bool> open(problem_.who.size(), false), all;  // by island
  for (std::size_t i = 0; i < problem_.who.size(); ++i) {
    const Participant& p = problem_.who[i];
    const bool opens = before_.contacts[p.contact].closed && !modes_.contacts[p.contact].closed;
    const bool just_presses = p.N > 0 && p.N <= undecided * p.violation * largest[i];
    if (p.unilateral && (just_presses || (opens && p.a_n <= least_acceleration(p)))) open[island[i]] = true;
  }
  for (const std::size_t k : island) all.push_back(open[k]);
  return all;
}

// [s] The time in which these contacts cross the length of their scene, or in which a slip ends. At the system's point,
// where a_ are the accelerations.
double ContactModes::time_of_change(const std::vector<bool>& asked) {
  double length = 0, speed = 0, largest = 0;
  const auto is_asked = [&](const Participant& p) { return asked[std::size_t(p.contact)]; };
  for (const Participant& p : problem_.who) {
    if (!is_asked(p)) continue;
    const Scale scale = scale_.of(p.contact);
    length = std::max(length, scale.length()), speed = std::max(speed, scale.speed);
    largest = std::max(largest, largest_[std::size_t(p.contact)]);
  }
  speed = std::max(speed, std::sqrt(largest * length));
  double least = speed > 0 ? length / speed : 0;
  for (const Participant& p : problem_.who) {
    if (p.tangent != Tangent::sliding || !is_asked(p)) continue;
    const Tangential slip = system_.slip(p.contact), change = system_.slip_acceleration(p.contact, a_);
    if (!(slip.dot(change) < 0)) continue;  // it does not slow down
    const double slips = slip.norm();
    if (slips > scale_.of(p.contact).rest_speed() && slips < least * change.norm()) least = slips / change.norm();
  }
  return least;
}

namespace {

// Modes of the contacts that are not asked are those decided.
void keep_others(const model::Modes& decided, const std::vector<bool>& asked, model::Modes& modes) {
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (!asked[i]) modes.contacts[i] = decided.contacts[i];
  const auto is_asked = [&](const model::SharedRows& group) {
    return asked[std::size_t(group.implied.front().contact)];
  };
  std::erase_if(modes.shared, [&](const model::SharedRows& group) { return !is_asked(group); });
  for (const model::SharedRows& group : decided.shared)
    if (!is_asked(group)) modes.shared.push_back(group);
}

}  // namespace

// Rule 11: decides by the state a moment later. `asked`: contacts whose modes are open.
complementarity::ContactSolution ContactModes::decide_by_what_follows(const State& state, ContactChanges changes,
                                                                      bool jumped, const std::vector<bool>& asked,
                                                                      complementarity::ContactSolution so_far) {
  using complementarity::LcpOutcome;
  const model::Modes decided = modes_;
  system_.set_modes(so_far.outcome == LcpOutcome::solved ? modes_ : before_);
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
    const complementarity::ContactSolution solution = decide(later, changes, jumped);
    system_.move_to(state.t, state.q, state.v);
    if (solution.outcome == LcpOutcome::solved) keep_others(decided, asked, modes_);
    if (solution.outcome != LcpOutcome::gave_up) return solution;
  }
  modes_ = decided;
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
    p.least_slip = scale_.of(p.contact).no_acceleration();
    p.a_n = system_.acceleration({p.contact, 0}, a_);
    if (p.tangent != Tangent::none) p.a_t = system_.slip_acceleration(p.contact, a_);
    largest[island[i]] = std::max({largest[island[i]], std::abs(p.a_n), p.a_t.norm()});
    least[island[i]] = std::max(least[island[i]], p.least_slip);
  }
  largest_.assign(modes_.contacts.size(), 0);
  for (std::size_t i = 0; i < island.size(); ++i) {
    Participant& p = problem_.who[i];
    largest_[std::size_t(p.contact)] = largest[island[i]];
    p.nothing = std::max(least[island[i]], 1e-12 * largest[island[i]]);
  }
}

void ContactModes::take_verdict(const Participant& p, bool kept_closed) {
  model::ContactMode& mode = modes_.contacts[p.contact];
  mode.closed = !p.unilateral || p.N > 0 || kept_closed;
  mode.friction = Friction::none;
  if (!mode.closed || p.tangent == Tangent::none || !system_.model().contacts[p.contact].coulomb) return;
  mode.friction = Friction::slide;
  mode.direction = p.direction;
  mode.least_slip = least_slip(p.contact);
  if (p.tangent == Tangent::sliding) return;
  if (p.a_t.norm() > p.no_slip) {
    mode.direction = direction_of(p.a_t);
  } else if (p.yielded && p.T.norm() > (1 - 1e-6) * p.mu * p.N) {  // slides, too slowly to be seen
    mode.direction = -direction_of(p.T);
  } else {
    mode.friction = Friction::stick;
    if (before_.contacts[p.contact].friction != Friction::stick) system_.anchor(p.contact, mode);
  }
}

}  // namespace trammel::simulate
