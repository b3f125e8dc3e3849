#include "simulate/impact/impact_directions.hpp"

namespace trammel::simulate {
namespace {

ImpactDirections::Friction coefficients(const model::ContactEntry& contact, double slip) {
  if (contact.coulomb) return {contact.coulomb->static_coefficient(), contact.coulomb->kinetic_coefficient(slip)};
  if (!contact.smooth) return {};
  const double ratio = contact.smooth->ratio(slip);
  return {ratio, ratio};
}

}  // namespace

void ImpactDirections::prepare(model::AssembledSystem& system, std::vector<TouchingContact>& touching) {
  std::vector<model::ContactDirection> directions;
  normal.clear(), tangent.clear(), friction.clear();
  tangents = touching.empty() ? 0 : system.tangents(touching.front().contact);  // the same for all that strike
  for (TouchingContact& c : touching) {
    const model::ContactEntry& contact = system.model().contacts[c.contact];
    if (contact.friction) c.slip_before = system.slip(c.contact);
    friction.push_back(coefficients(contact, c.slip_before.norm()));
    normal.push_back(int(directions.size())), directions.push_back({c.contact, 0});
    tangent.push_back(contact.friction ? int(directions.size()) : -1);
    for (int k = 1; k <= tangents && contact.friction; ++k) directions.push_back({c.contact, k});
  }
  system.impulse_response(directions, jump, A);
  rates.resize(A.rows());
  for (std::size_t i = 0; i < touching.size(); ++i) {
    rates[normal[i]] = touching[i].was_closed ? 0 : touching[i].before;
    if (tangent[i] >= 0) rates.segment(tangent[i], tangents) = touching[i].slip_before.head(tangents);
  }
}

}  // namespace trammel::simulate
