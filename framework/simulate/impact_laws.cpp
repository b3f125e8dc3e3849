#include "simulate/impact_laws.hpp"

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

}  // namespace

complementarity::ContactSolution ImpactLaws::solve(model::AssembledSystem& system, double at_rest,
                                                   std::vector<TouchingContact>& touching, Vec& dv) {
  cut_short_ = false;
  switch (law_of(system.model(), at_rest, touching)) {
    case Law::newton:
      return newton_.solve(system, at_rest, touching, dv);
    case Law::poisson:
      return poisson_.solve(system, at_rest, touching, dv);
    case Law::energetic:
      break;
  }
  const complementarity::ContactSolution solution = energetic_.solve(system, touching, dv);
  cut_short_ = energetic_.cut_short();
  return solution;
}

}  // namespace trammel::simulate
