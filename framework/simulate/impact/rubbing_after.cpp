#include "simulate/impact/rubbing_after.hpp"

#include <algorithm>

#include "simulate/impact/impact_friction.hpp"

namespace trammel::simulate {
namespace {

// [m/s] The rate that steps have left in a closed contact. It keeps this rate; its gap rate is counted from there, as
// in the impact before.
double drift(const TouchingContact& c) {
  return c.was_closed ? c.before : 0;
}

Participant participant(const model::ContactEntry& entry, const TouchingContact& c) {
  Participant p;
  p.contact = c.contact;
  p.unilateral = !entry.joint;
  p.N = c.impulse, p.T = c.friction;
  p.a_n = std::max(0.0, c.after - drift(c));
  p.a_t = c.slip_after;
  if (entry.friction) p.tangent = Participant::Tangent::resting;
  return p;
}

// Adds the impulses found to `c`.
void add(const Participant& p, TouchingContact& c) {
  const double normal = p.unilateral ? p.N * (c.after - drift(c) + p.a_n) : 0;
  const double lost = c.energy_lost() - 0.5 * (normal + p.T.dot(c.slip_after + p.a_t));
  c.impulse += p.N;
  c.friction += p.T;
  if (p.unilateral) c.after = p.a_n + drift(c);
  c.slip_after = p.a_t;
  c.course = 0;
  c.course = lost - c.loss_at_mean_rates();
}

}  // namespace

complementarity::ContactSolution RubbingAfter::solve(model::AssembledSystem& system, const State& state, double at_rest,
                                                     std::vector<TouchingContact>& touching, Vec& dv) {
  const auto entry = [&](const TouchingContact& c) -> const model::ContactEntry& {
    return system.model().contacts[std::size_t(c.contact)];
  };
  State after = state;
  after.v += dv;
  system.move_to(after.t, after.q, after.v);
  problem_.who.clear();
  for (TouchingContact& c : touching) {
    if (entry(c).joint) c.slip_before = c.slip_after = system.slip(c.contact);
    problem_.who.push_back(participant(entry(c), c));
  }
  problem_.prepare(system);
  bearings_.prepare(system, after, problem_.who);
  take_islands(bearings_.join(problem_.islands(), problem_.who), touching);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const ImpactFriction friction = friction_in_impact(entry(touching[i]), touching[i], touching[i].slip_after.norm());
    problem_.who[i].mu_0 = friction.mu_0, problem_.who[i].mu = friction.mu;
  }
  const Vec applied = bearings_.reaction(problem_.who);
  const auto solution = bearings_.solve(problem_, at_rest, BearingImpulses::From::nothing, applied);
  system.move_to(state.t, state.q, state.v);
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  Vec rubbed;
  problem_.jump(rubbed);
  dv += rubbed;
  for (std::size_t i = 0; i < touching.size(); ++i) add(problem_.who[i], touching[i]);
  return solution;
}

}  // namespace trammel::simulate
