#include "simulate/contact_mode.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "numerics/lcp.hpp"
#include "simulate/run_failed.hpp"

namespace trammel::simulate {
namespace {

bool contains(const std::vector<int>& list, int i) {
  return std::find(list.begin(), list.end(), i) != list.end();
}

// A contact that comes to rest at its onset has no approach speed for a damping law to scale with; this is the least it gets.
constexpr double least_approach_speed = 1e-6;  // [m/s]

}  // namespace

double ContactModes::touching_gap(const State& state) {
  return 1e-12 * std::max(1.0, state.q.size() ? state.q.cwiseAbs().maxCoeff() : 0.0);
}

bool ContactModes::any_closed() const {
  const auto& contacts = system_.modes().contacts;
  return std::any_of(contacts.begin(), contacts.end(), [](const model::ContactMode& mode) { return mode.closed; });
}

double ContactModes::settle(State& state, const ContactChanges& changes, std::vector<ContactEvent>& events) {
  const int n = int(system_.model().contacts.size());
  system_.move_to(state.t, state.q, state.v);
  before_ = modes_ = system_.modes();
  std::vector<int> rows_before(n);
  for (int i = 0; i < n; ++i) rows_before[i] = system_.contact_row(i);
  const Vec lambda_before = state.lambda;

  toggle(state, changes.toggled, events);
  find_touching(state, changes);
  const double elsewhere = changes.struck.empty() ? 0 : strike(state);
  bool carry = false;
  for (const TouchingContact& c : touching_) {
    const bool struck = contains(changes.struck, c.contact);
    carry = carry || ((struck || contains(changes.released, c.contact)) &&
                      treatment(c.contact).restart == Restitution::Restart::carry);
    if (!c.was_closed && c.impulse > 0)
      events.push_back(
          {state.t, ContactEvent::Kind::impact, c.contact, c.impulse, -c.before, c.after, c.energy_lost()});
    if (struck || (!c.was_closed && c.impulse > 0)) {
      modes_.contacts[c.contact].approach_speed = -c.before;
    }
  }
  find_candidates(changes);
  close_pushing(state);
  finish(state, rows_before, lambda_before, carry, events);
  return elsewhere;
}

void ContactModes::toggle(const State& state, const std::vector<int>& contacts, std::vector<ContactEvent>& events) {
  for (const int i : contacts) {
    model::ContactMode& mode = modes_.contacts[i];
    const double rate = system_.gap_rate(i);
    mode.closed = !mode.closed;
    if (mode.closed) mode.approach_speed = std::max(-rate, least_approach_speed);
    events.push_back(
        {state.t, mode.closed ? ContactEvent::Kind::close : ContactEvent::Kind::open, i, 0, -rate, rate, 0});
  }
}

void ContactModes::find_touching(const State& state, const ContactChanges& changes) {
  touching_.clear();
  const double near = touching_gap(state);
  for (int i = 0; i < int(system_.model().contacts.size()); ++i) {
    const Restitution* law = system_.model().contacts[i].restitution;
    if (!law) continue;
    const bool closed = before_.contacts[i].closed, struck = contains(changes.struck, i);
    if (!closed && !struck && system_.gap(i) > near) continue;
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
    if (!impact_.solve(system_, touching_, dv_)) {
      std::string names;
      for (const TouchingContact& c : touching_)
        names += (names.empty() ? "" : ", ") + system_.model().contacts[c.contact].name;
      throw RunFailed(fmt::format("the impact of contacts {} has no solution", names));
    }
    state.v = v_before_ + dv_;
    if (!capture_chatter(state, state.v)) break;
    system_.move_to(state.t, state.q, v_before_);
  }
  system_.move_to(state.t, state.q, state.v);
  double elsewhere = kinetic_before - system_.energy().kinetic;
  for (const TouchingContact& c : touching_) elsewhere -= c.energy_lost();
  return elsewhere;
}

// Takes e = 0 where the rebound would be too short to step through; true if there is such a contact.
bool ContactModes::capture_chatter(const State& state, const Vec& v) {
  const auto rebounds = [](const TouchingContact& c) { return c.restitution > 0 && c.impulse > 0; };
  if (chatter_time_ <= 0 || std::none_of(touching_.begin(), touching_.end(), rebounds)) return false;
  free_accelerations(state.t, state.q, v);
  bool captured = false;
  for (TouchingContact& c : touching_) {
    if (!rebounds(c)) continue;
    const double A = system_.gap_acceleration(c.contact, a_);
    if (A < 0 && 2 * c.after < chatter_time_ * -A) c.restitution = 0, captured = true;
  }
  system_.set_modes(before_);
  return captured;
}

// a_ with every touching contact open.
void ContactModes::free_accelerations(double t, const Vec& q, const Vec& v) {
  model::Modes open = modes_;
  for (const TouchingContact& c : touching_) open.contacts[c.contact].closed = false;
  system_.set_modes(open);
  system_.move_to(t, q, v);
  system_.accelerate({}, a_, lambda_);
}

void ContactModes::find_candidates(const ContactChanges& changes) {
  candidates_.clear();
  double scale = 0;
  for (const TouchingContact& c : touching_) scale = std::max(scale, std::abs(c.before));
  const double at_rest = 1e-9 * scale + 1e-12;  // [m/s] round-off of the jump
  for (const TouchingContact& c : touching_) {
    const bool constrained = c.impulse > 0 && treatment(c.contact).rebound == Restitution::Rebound::constrained;
    const bool rests = std::abs(c.was_closed ? c.after - c.before : c.after) <= at_rest;
    const bool released = contains(changes.released, c.contact) && c.impulse == 0;
    if ((rests || constrained) && !released) candidates_.push_back(c.contact);
  }
}

// Rule 3.
void ContactModes::close_pushing(const State& state) {
  for (const TouchingContact& c : touching_) modes_.contacts[c.contact].closed = false;
  const auto n = Eigen::Index(candidates_.size());
  if (n == 0) return;
  free_accelerations(state.t, state.q, state.v);
  gap_accelerations_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) gap_accelerations_[i] = system_.gap_acceleration(candidates_[i], a_);
  Mat jump, delassus;
  Vec force, apart;
  system_.impulse_response(candidates_, jump, delassus);
  if (numerics::solve_lcp(delassus, gap_accelerations_, force, apart) != numerics::LcpOutcome::solved)
    throw RunFailed("the contact forces that keep the closed contacts from penetrating have no solution");
  const double scale = gap_accelerations_.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < n; ++i) {
    // Of redundant contacts the solution loads only some; the others carry nothing, but must not be left to fall.
    const bool rests = gap_accelerations_[i] < 0 && apart[i] <= 1e-12 * scale;
    modes_.contacts[candidates_[i]].closed = force[i] > 0 || rests;
  }
}

void ContactModes::finish(State& state, const std::vector<int>& rows_before, const Vec& lambda_before, bool carry,
                          std::vector<ContactEvent>& events) {
  system_.set_modes(modes_);
  system_.move_to(state.t, state.q, state.v);
  if (carry) {
    const int joint_rows = system_.model().sizes.nc;
    state.lambda.setZero(system_.sizes().nc);
    if (lambda_before.size() >= joint_rows) state.lambda.head(joint_rows) = lambda_before.head(joint_rows);
    for (int i = 0; i < int(rows_before.size()); ++i)
      if (system_.contact_row(i) >= 0 && rows_before[i] >= 0 && rows_before[i] < lambda_before.size())
        state.lambda[system_.contact_row(i)] = lambda_before[rows_before[i]];
  } else {
    system_.accelerate({}, state.a, state.lambda);
  }
  for (const TouchingContact& c : touching_) {
    const bool closed = modes_.contacts[c.contact].closed;
    if (closed != c.was_closed) {
      const auto kind = closed ? ContactEvent::Kind::close : ContactEvent::Kind::open;
      events.push_back({state.t, kind, c.contact, 0, -c.before, c.after, 0});
    } else if (!closed && contains(candidates_, c.contact) && c.impulse > 0) {
      events.push_back({state.t, ContactEvent::Kind::lift, c.contact, 0, -c.before, c.after, 0});
    }
  }
}

}  // namespace trammel::simulate
