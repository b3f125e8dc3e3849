#include "simulate/impact/impact_laws.hpp"

#include <algorithm>

namespace trammel::simulate {
namespace {

using Law = Restitution::ImpactLaw;

Law law_of(const model::Model& model, double at_rest, const std::vector<TouchingContact>& touching) {
  Law law = Law::newton;
  for (const TouchingContact& c : touching)
    if (!c.was_closed && !c.without_collision && c.before < -at_rest)
      law = std::max(law, model.contacts[std::size_t(c.contact)].restitution->treatment().impact_law);
  return law;
}

// True if an impulse changes the slip of a contact that slides. Those of contacts at rest are round-off.
bool has_impulse(const std::vector<TouchingContact>& touching) {
  return std::any_of(touching.begin(), touching.end(), [](const TouchingContact& c) {
    const double slip = c.slip_before.norm(), change = (c.slip_after - c.slip_before).norm();
    return c.slides && c.impulse > 0 && change > 100 * vanishing_approach * slip;
  });
}

}  // namespace

complementarity::ContactSolution ImpactLaws::solve(model::AssembledSystem& system, const State& state, double at_rest,
                                                   std::vector<TouchingContact>& touching, Vec& dv) {
  cut_short_ = false;
  law_ = law_of(system.model(), at_rest, touching);
  const auto rubs = [&](const TouchingContact& c) {
    return system.model().contacts[std::size_t(c.contact)].joint.has_value();
  };
  if (law_ == Law::newton) {
    const complementarity::ContactSolution solution = newton_.solve(system, state, at_rest, touching, dv);
    const auto without_collision = [&](const TouchingContact& c) { return c.without_collision && !rubs(c); };
    if (std::none_of(touching.begin(), touching.end(), without_collision)) return solution;
    if (solution.outcome == complementarity::LcpOutcome::solved && has_impulse(touching)) return solution;
    return std::any_of(touching.begin(), touching.end(), rubs) ? solution : end_slip(system, touching, dv);
  }
  const auto joints =
      std::stable_partition(touching.begin(), touching.end(), [&](const TouchingContact& c) { return !rubs(c); });
  std::vector<TouchingContact> bearings(joints, touching.end());
  touching.erase(joints, touching.end());
  complementarity::ContactSolution solution = strike(system, at_rest, touching, dv);
  touching.insert(touching.end(), bearings.begin(), bearings.end());
  if (solution.outcome == complementarity::LcpOutcome::solved && !bearings.empty())
    solution = rubbing_after_.solve(system, state, at_rest, touching, dv);
  return solution;
}

complementarity::ContactSolution ImpactLaws::end_slip(model::AssembledSystem& system,
                                                      std::vector<TouchingContact>& touching, Vec& dv) {
  complementarity::ContactSolution solution = energetic_.solve(system, touching, dv);
  cut_short_ = energetic_.cut_short();
  if (solution.outcome == complementarity::LcpOutcome::solved && !has_impulse(touching))
    solution.outcome = complementarity::LcpOutcome::no_solution;
  return solution;
}

complementarity::ContactSolution ImpactLaws::strike(model::AssembledSystem& system, double at_rest,
                                                    std::vector<TouchingContact>& touching, Vec& dv) {
  if (law_ == Law::poisson) return poisson_.solve(system, at_rest, touching, dv);
  const complementarity::ContactSolution solution = energetic_.solve(system, touching, dv);
  cut_short_ = energetic_.cut_short();
  return solution;
}

}  // namespace trammel::simulate
