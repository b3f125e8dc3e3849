// Rule 10 of contact_mode.hpp: which joints that rub stick and slide.
//
// Their loads, which bound the friction, follow from the reactions, and these from the friction and from all contacts.
// Rounds find modes that agree with their own loads:
//
//     loads of the modes of the last round, exactly (AssembledSystem::accelerate)  ->  problem with these loads given
//     ->  modes
//
// A joint that locks itself while it slides has none: it jams (rule 8).
//
// The round that gives the same modes again is the check: it solves the whole problem with the loads of its own
// solution. The first round has the loads with which all that may rest rests, so where a joint could stay or go, it
// stays.
#include <algorithm>

#include <fmt/format.h>

#include "run/run_failed.hpp"
#include "simulate/contact_mode.hpp"
#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

constexpr int most_rounds = 50;  // two or three, as a rule

// The same state of contacts; in space slip may begin in a direction that follows from the loads.
bool agree(const model::Modes& a, const model::Modes& b) {
  const auto same = [](const model::ContactMode& x, const model::ContactMode& y) {
    return x.closed == y.closed && x.friction == y.friction && (x.direction - y.direction).norm() <= 1e-9;
  };
  return std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(), same);
}

}  // namespace

bool ContactModes::has_bearings() const {
  return std::any_of(problem_.who.begin(), problem_.who.end(),
                     [this](const Participant& p) { return system_.model().contacts[p.contact].joint.has_value(); });
}

// Fills `given` of the joints.
void ContactModes::load_bearings(const State& state, const model::Modes& modes) {
  system_.set_modes(modes);
  system_.move_to(state.t, state.q, state.v);
  Vec a;
  system_.accelerate({}, a, lambda_);
  for (Participant& p : problem_.who)
    if (system_.model().contacts[p.contact].joint) p.given = system_.normal_force(p.contact, lambda_);
}

void ContactModes::load_bearings_at_rest(const State& state, const model::Modes& open) {
  model::Modes at_rest = open;
  at_rest.shared = before_.shared;
  for (const Participant& p : problem_.who) {
    model::ContactMode& mode = at_rest.contacts[p.contact];
    const bool joint = system_.model().contacts[p.contact].joint.has_value();
    if (!joint) {
      mode = before_.contacts[p.contact];
      continue;
    }
    mode.closed = true;
    if (!system_.model().contacts[p.contact].coulomb || p.tangent == Participant::Tangent::none) continue;
    mode.friction = p.tangent == Participant::Tangent::resting ? Friction::stick : Friction::slide;
    mode.direction = p.direction;
  }
  load_bearings(state, at_rest);
}

// No solution where bearings that slide find none for their loads.
complementarity::ContactSolution ContactModes::decide_with_bearings(const State& state) try {
  const std::vector<Participant> asked = problem_.who;
  const model::Modes open = modes_;
  model::Modes last;
  load_bearings_at_rest(state, open);
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<Participant> who = asked;
    for (std::size_t i = 0; i < who.size(); ++i)
      if (system_.model().contacts[who[i].contact].joint) who[i].given = problem_.who[i].given;
    problem_.who = std::move(who);
    modes_ = open;
    const complementarity::ContactSolution solution = take_verdicts();
    if (solution.outcome != complementarity::LcpOutcome::solved || (round > 0 && agree(modes_, last))) return solution;
    last = modes_;
    load_bearings(state, modes_);
  }
  return {complementarity::LcpOutcome::no_solution, 0};
} catch (const model::LocksItself&) {
  return {complementarity::LcpOutcome::no_solution, 0};
}

void ContactModes::fail_on_bearings(double t) const {
  std::string names;
  for (const Participant& p : problem_.who)
    if (const model::ContactEntry& entry = system_.model().contacts[p.contact]; entry.joint)
      names += (names.empty() ? "" : ", ") + entry.path();
  throw RunFailed(
      fmt::format("at t = {:.9g} s: gave up on the friction of {}: in {} rounds no modes were found, sticking or "
                  "sliding, that agree with the loads of the bearings that follow from them, nor an impulse after "
                  "which there are some; with so much "
                  "friction a joint may lock itself",
                  t, names, most_rounds));
}

}  // namespace trammel::simulate
