#include "simulate/impact/rubbing_after.hpp"

#include <algorithm>

namespace trammel::simulate {
namespace {

// [m/s] What a closed contact keeps of the rate that the steps left it: its gap's rate counts from there, as in the
// impact before.
double drift(const TouchingContact& c) {
  return c.was_closed ? c.before : 0;
}

Participant participant(model::AssembledSystem& system, const TouchingContact& c) {
  const model::ContactEntry& entry = system.model().contacts[std::size_t(c.contact)];
  Participant p;
  p.contact = c.contact;
  p.unilateral = !entry.joint;
  p.N = c.impulse, p.T = c.friction;
  p.a_n = std::max(0.0, c.after - drift(c));
  p.a_t = c.slip_after;
  if (!entry.coulomb) return p;
  p.tangent = Participant::Tangent::resting;
  p.mu_0 = entry.coulomb->static_coefficient();
  p.mu = entry.coulomb->kinetic_coefficient(p.a_t.norm());
  return p;
}

// To `c` what was found for it.
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
                                                     std::vector<TouchingContact>& touching,
                                                     std::vector<TouchingContact>& bearings, Vec& dv) {
  State after = state;
  after.v += dv;
  system.move_to(after.t, after.q, after.v);
  for (TouchingContact& c : bearings) c.slip_after = system.slip(c.contact);
  problem_.who.clear();
  for (const TouchingContact& c : touching) problem_.who.push_back(participant(system, c));
  for (const TouchingContact& c : bearings) problem_.who.push_back(participant(system, c));
  problem_.prepare(system);
  bearings_.prepare(system, after, problem_.who);
  const Vec applied = bearings_.reaction(problem_.who);
  const auto solution = bearings_.solve(problem_, at_rest, BearingImpulses::From::nothing, applied);
  system.move_to(state.t, state.q, state.v);
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  Vec rubbed;
  problem_.jump(rubbed);
  dv += rubbed;
  for (std::size_t i = 0; i < touching.size(); ++i) add(problem_.who[i], touching[i]);
  for (std::size_t j = 0; j < bearings.size(); ++j) {
    bearings[j].slip_before = bearings[j].slip_after;
    add(problem_.who[touching.size() + j], bearings[j]);
  }
  return solution;
}

}  // namespace trammel::simulate
