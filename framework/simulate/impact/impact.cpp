#include "simulate/impact/impact.hpp"

#include <cmath>

#include "simulate/impact/impact_friction.hpp"

namespace trammel::simulate {
complementarity::ContactSolution Impact::solve(model::AssembledSystem& system, const State& state, double at_rest,
                                               std::vector<TouchingContact>& touching, Vec& dv) {
  problem_.who.clear();
  auto from = BearingImpulses::From::nothing;
  for (TouchingContact& c : touching) {
    const model::ContactEntry& entry = system.model().contacts[c.contact];
    Participant p;
    p.contact = c.contact;
    p.a_n = c.was_closed ? 0 : (1 + c.restitution) * c.before;
    if (entry.friction) p.a_t = c.slip_before = system.slip(c.contact);
    if (entry.joint) {
      p.unilateral = false;
      if (c.without_collision) from = BearingImpulses::From::held;
    } else if (c.without_collision) {
      p.vanishing = vanishing_approach * c.slip_before.norm();
    }
    if (entry.friction) p.tangent = Participant::Tangent::resting;
    problem_.who.push_back(p);
  }
  problem_.prepare(system);
  bearings_.prepare(system, state, problem_.who);
  take_islands(bearings_.join(problem_.islands(), problem_.who), touching);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const TouchingContact& c = touching[i];
    const ImpactFriction friction =
        friction_in_impact(system.model().contacts[std::size_t(c.contact)], c, c.slip_before.norm());
    problem_.who[i].mu_0 = friction.mu_0, problem_.who[i].mu = friction.mu;
  }
  complementarity::ContactSolution solution = bearings_.solve(problem_, at_rest, from);
  // Closed contacts keep the rates that steps have left in them, unless the rates of dependent contacts then contradict
  // each other (a stack that touches floor and ceiling).
  const bool ends_drift = solution.outcome == complementarity::LcpOutcome::no_solution;
  for (std::size_t i = 0; i < touching.size() && ends_drift; ++i)
    problem_.who[i].a_n = touching[i].before, problem_.who[i].let_go = false;
  if (ends_drift) solution = bearings_.solve(problem_, at_rest, from);
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  problem_.jump(dv);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    TouchingContact& c = touching[i];
    const Participant& p = problem_.who[i];
    c.impulse = p.N;
    // Where the impulse acts, the complementarity gives -e u- exactly, without the round-off of D L.
    if (system.model().contacts[c.contact].joint)
      c.after = c.before;
    else if (c.was_closed && ends_drift)
      c.after = p.N > 0 ? 0 : p.a_n;
    else if (c.impulse > 0)
      c.after = c.was_closed ? c.before : -c.restitution * c.before;
    else
      c.after = p.a_n - (c.was_closed ? -c.before : c.restitution * c.before);
    c.friction = p.T;
    c.slip_after = p.a_t;
    c.course = 0;
  }
  return solution;
}

}  // namespace trammel::simulate
