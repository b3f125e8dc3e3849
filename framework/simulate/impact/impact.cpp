#include "simulate/impact/impact.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/impact/impact_friction.hpp"

namespace trammel::simulate {
namespace {

// Whether the impact without rebounds and drifts is another one.
bool may_jam(complementarity::LcpOutcome outcome, const std::vector<TouchingContact>& touching) {
  const auto rebounds = [](const TouchingContact& c) { return c.restitution > 0; };
  return outcome == complementarity::LcpOutcome::no_solution ||
         (outcome == complementarity::LcpOutcome::gave_up && std::any_of(touching.begin(), touching.end(), rebounds));
}

}  // namespace

// Finds the islands that have no impulses as asked, each beside others without rebounds and drifts, which have some.
complementarity::ContactSolution Impact::solve_jammed(const std::vector<Participant>& asked, double at_rest,
                                                      BearingImpulses::From from,
                                                      const std::vector<TouchingContact>& touching,
                                                      std::vector<bool>& jams) {
  const auto solve_as = [&](const std::vector<bool>& jammed) {
    problem_.who = asked;
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (jammed[i]) problem_.who[i].a_n = touching[i].before;
    return bearings_.solve(problem_, at_rest, from);
  };
  std::vector<bool> judged(touching.size(), false);  // by island
  for (const TouchingContact& each : touching) {
    if (judged[each.island]) continue;
    judged[each.island] = true;
    std::vector<bool> others;
    for (const TouchingContact& c : touching) others.push_back(c.island != each.island);
    const bool alone = std::none_of(others.begin(), others.end(), [](bool other) { return other; });
    if (!alone && solve_as(others).outcome == complementarity::LcpOutcome::solved) continue;
    for (std::size_t i = 0; i < touching.size(); ++i) jams[i] = jams[i] || !others[i];
  }
  return solve_as(jams);
}

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
  const std::vector<Participant> asked = problem_.who;
  std::vector<bool> jams(touching.size(), false);
  complementarity::ContactSolution solution = bearings_.solve(problem_, at_rest, from);
  if (may_jam(solution.outcome, touching)) solution = solve_jammed(asked, at_rest, from, touching, jams);
  if (solution.outcome != complementarity::LcpOutcome::solved) return solution;
  problem_.jump(dv);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    TouchingContact& c = touching[i];
    const Participant& p = problem_.who[i];
    if (jams[i]) c.restitution = 0;
    c.impulse = p.N;
    // Where the impulse acts, the complementarity gives -e u- exactly, without the round-off of D L.
    if (system.model().contacts[c.contact].joint)
      c.after = c.before;
    else if (c.was_closed && jams[i])
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
