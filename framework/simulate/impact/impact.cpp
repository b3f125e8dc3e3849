#include "simulate/impact/impact.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/impact/impact_friction.hpp"

namespace trammel::simulate {
namespace {

// Whether the problem without rebounds and drifts is another one, which may have a solution.
bool may_jam(complementarity::LcpOutcome outcome, const std::vector<TouchingContact>& touching) {
  const auto rebounds = [](const TouchingContact& c) { return c.restitution > 0; };
  return outcome == complementarity::LcpOutcome::no_solution ||
         (outcome == complementarity::LcpOutcome::gave_up && std::any_of(touching.begin(), touching.end(), rebounds));
}

}  // namespace

// `jams`: contacts of the islands that have no solution as asked. Each island is tried with all others jammed, which
// have a solution then.
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

// Sets the participants and their rates, those of open contacts with their rebounds. Returns where the search for the
// loads of bearings begins.
BearingImpulses::From Impact::gather(model::AssembledSystem& system, std::vector<TouchingContact>& touching) {
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
      p.vanishing = c.approach;
    }
    if (entry.friction) p.tangent = c.slides_on ? Participant::Tangent::sliding : Participant::Tangent::resting;
    if (c.slides_on) p.a_t.setZero();
    problem_.who.push_back(p);
  }
  return from;
}

// To be called when the islands of the contacts are known.
void Impact::take_coefficients(const model::Model& model, const std::vector<TouchingContact>& touching) {
  for (std::size_t i = 0; i < touching.size(); ++i) {
    const TouchingContact& c = touching[i];
    const ImpactFriction friction = friction_in_impact(model.contacts[std::size_t(c.contact)], c, c.slip_before.norm());
    problem_.who[i].mu_0 = friction.mu_0, problem_.who[i].mu = friction.mu;
    if (c.slides_on) problem_.who[i].ratio = -friction.mu * direction_of(c.slip_before);
  }
}

// [m/s] u+ of a contact. Where the impulse acts, the complementarity gives -e u- exactly, without the round-off of D L.
double Impact::rate_after(const TouchingContact& c, const Participant& p, bool joint, bool jams) {
  if (joint) return c.before;
  if (c.was_closed && jams) return p.N > 0 ? 0 : p.a_n;
  if (p.N > 0) return c.was_closed ? c.before : -c.restitution * c.before;
  return p.a_n - (c.was_closed ? -c.before : c.restitution * c.before);
}

complementarity::ContactSolution Impact::solve(model::AssembledSystem& system, const State& state, double at_rest,
                                               std::vector<TouchingContact>& touching, Vec& dv) {
  const BearingImpulses::From from = gather(system, touching);
  problem_.prepare(system);
  bearings_.prepare(system, state, problem_.who);
  take_islands(bearings_.join(problem_.islands(), problem_.who), touching);
  take_coefficients(system.model(), touching);
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
    c.after = rate_after(c, p, system.model().contacts[c.contact].joint.has_value(), jams[i]);
    c.friction = p.T;
    c.slip_after = c.slides_on ? Tangential(c.slip_before + p.a_t) : p.a_t;
    c.course = 0;
  }
  return solution;
}

}  // namespace trammel::simulate
