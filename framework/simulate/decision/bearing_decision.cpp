#include "simulate/decision/bearing_decision.hpp"

#include <algorithm>

#include "simulate/impact/bearing_impulses.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {

using complementarity::LcpOutcome;
using Friction = model::ContactMode::Friction;

namespace {

constexpr int most_rounds = 50;          // usually two or three are needed
constexpr double same_direction = 1e-9;  // [rad] of slips, which follow from the loads: their round-off

// The same state of contacts; in space slip may begin in a direction that follows from the loads.
bool agree(const model::Modes& a, const model::Modes& b) {
  const auto same = [](const model::ContactMode& x, const model::ContactMode& y) {
    return x.closed == y.closed && x.friction == y.friction && (x.direction - y.direction).norm() <= same_direction;
  };
  return std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(), same);
}

// A contact of a group may have opened in an impact, and one that stuck may slide after it: their rows are gone.
bool all_have_rows(const std::vector<model::SharedRows>& groups, const model::Modes& modes) {
  const auto has_row = [&](const model::ContactDirection& d) {
    const model::ContactMode& mode = modes.contacts[std::size_t(d.contact)];
    return mode.closed && (d.row == 0 || mode.friction == Friction::stick);
  };
  return std::all_of(groups.begin(), groups.end(), [&](const model::SharedRows& group) {
    return std::all_of(group.basis.begin(), group.basis.end(), has_row) &&
           std::all_of(group.implied.begin(), group.implied.end(), has_row);
  });
}

// At the system's point.
void take_tangent(const Participant& p, model::AssembledSystem& system, model::ContactMode& mode) {
  const bool rests = p.tangent == Participant::Tangent::resting;
  if (rests && mode.friction != Friction::stick) system.anchor(p.contact, mode);
  mode.friction = rests ? Friction::stick : Friction::slide;
  mode.direction = p.direction;
}

}  // namespace

bool BearingDecision::is_joint(const Participant& p) const {
  return system_.model().contacts[p.contact].joint.has_value();
}

bool BearingDecision::any_bearings() const {
  return std::any_of(problem_.who.begin(), problem_.who.end(), [this](const Participant& p) { return is_joint(p); });
}

// Sets the given normal forces of the joints to their loads in these modes.
void BearingDecision::load_bearings(const State& state, const model::Modes& modes) {
  system_.set_modes(modes);
  system_.move_to(state.t, state.q, state.v);
  Vec a, lambda;
  system_.accelerate({}, a, lambda);
  for (Participant& p : problem_.who)
    if (is_joint(p)) p.given = system_.normal_force(p.contact, lambda);
}

void BearingDecision::load_bearings_at_rest(const State& state, const model::Modes& open) {
  model::Modes at_rest = open;
  for (const Participant& p : problem_.who) {
    model::ContactMode& mode = at_rest.contacts[p.contact];
    if (!is_joint(p)) {
      mode = at_.before.contacts[p.contact];
      continue;
    }
    mode.closed = true;
    if (!system_.model().contacts[p.contact].coulomb || p.tangent == Participant::Tangent::none) continue;
    take_tangent(p, system_, mode);
  }
  at_rest.shared = at_.before.shared;
  if (!all_have_rows(at_.before.shared, at_rest)) {  // the groups of friction as it is now, also of the other contacts
    for (const Participant& p : problem_.who)
      if (system_.model().contacts[p.contact].coulomb && p.tangent != Participant::Tangent::none)
        take_tangent(p, system_, at_rest.contacts[p.contact]);
    at_rest.shared = problem_.shared_rows(at_rest);
  }
  load_bearings(state, at_rest);
}

// The joint was at rest in the modes that gave its load (null: the modes of load_bearings_at_rest) and slides under it.
bool BearingDecision::was_not_held(const Participant& p, const model::Modes* loads) const {
  return is_joint(p) && p.tangent == Participant::Tangent::resting &&
         at_.modes.contacts[p.contact].friction == Friction::slide &&
         (!loads || loads->contacts[p.contact].friction == Friction::stick);
}

// Decides all modes with the joints' present loads given.
complementarity::ContactSolution BearingDecision::take_verdicts_under_loads(const State& state, Asked asked,
                                                                            const model::Modes& open) {
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (is_joint(asked[i])) asked[i].given = problem_.who[i].given;
  for (;;) {
    problem_.who = asked;
    at_.modes = open;
    const complementarity::ContactSolution solution = by_forces_.solve(state);
    if (solution.outcome != LcpOutcome::solved || by_forces_.share_within_bounds(state)) return solution;
    for (std::size_t i = 0; i < asked.size(); ++i) asked[i].let_go = problem_.who[i].let_go;
  }
}

// `asked`: participants none of which slides.
complementarity::ContactSolution BearingDecision::decide_at_rest(const State& state, const Asked& asked,
                                                                 const model::Modes& open) {
  BearingImpulses bearings;
  Vec a, lambda;
  double nothing = 0;
  for (const Participant& p : asked) nothing = std::max(nothing, p.nothing);
  for (const auto from : {BearingImpulses::From::nothing, BearingImpulses::From::held}) try {
      system_.set_modes(open);
      system_.move_to(state.t, state.q, state.v);
      system_.accelerate({}, a, lambda);
      const Vec applied = lambda.head(system_.held_rows());
      bearings.prepare(system_, state, asked);
      problem_.who = asked;
      if (bearings.solve(problem_, nothing, from, applied).outcome != LcpOutcome::solved) continue;
      if (take_verdicts_under_loads(state, asked, open).outcome != LcpOutcome::solved) continue;
      const model::Modes found = at_.modes;
      load_bearings(state, found);
      const auto solution = take_verdicts_under_loads(state, asked, open);
      if (solution.outcome != LcpOutcome::solved || !agree(at_.modes, found)) continue;
      undecided_ = false;
      return solution;
    } catch (const model::LocksItself&) {
    }
  undecided_ = true;
  return {LcpOutcome::gave_up, 0};
}

complementarity::ContactSolution BearingDecision::decide(const State& state) {
  const Asked asked = problem_.who;
  const model::Modes open = at_.modes;
  const auto rests = [](const Participant& p) { return p.tangent != Participant::Tangent::sliding; };
  const bool all_rest = std::all_of(asked.begin(), asked.end(), rests);
  try {
    const auto solution = decide_in_rounds(state, asked, open);
    if (solution.outcome != LcpOutcome::gave_up || !all_rest) return solution;
  } catch (const model::LocksItself&) {
    if (!all_rest) return {LcpOutcome::no_solution, 0};
  }
  return decide_at_rest(state, asked, open);
}

complementarity::ContactSolution BearingDecision::decide_in_rounds(const State& state, Asked asked,
                                                                   const model::Modes& open) {
  std::vector<bool> not_held(asked.size(), false);
  std::vector<model::Modes> had;  // found since the last joint let go
  try {
    load_bearings_at_rest(state, open);
  } catch (const model::LocksItself&) {  // near a dead centre: at rest, one joint would stop the others at once
    load_bearings(state, open);
  }
  for (int round = 0; round < most_rounds; ++round) {
    const complementarity::ContactSolution solution = take_verdicts_under_loads(state, asked, open);
    if (solution.outcome != LcpOutcome::solved) return solution;
    const model::Modes* last = had.empty() ? nullptr : &had.back();
    if (last && agree(at_.modes, *last)) return solution;
    for (std::size_t i = 0; i < asked.size(); ++i) not_held[i] = not_held[i] || was_not_held(problem_.who[i], last);
    if (std::any_of(had.begin(), had.end(), [this](const model::Modes& modes) { return agree(at_.modes, modes); })) {
      bool more = false;
      for (std::size_t i = 0; i < asked.size(); ++i)
        if (not_held[i] && !asked[i].let_go) asked[i].let_go = more = true;
      if (!more) break;
      had.clear();
    }
    had.push_back(at_.modes);
    load_bearings(state, at_.modes);
  }
  undecided_ = true;
  return {LcpOutcome::gave_up, 0};
}

}  // namespace trammel::simulate
