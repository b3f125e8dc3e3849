#include "simulate/impact/impact_directions.hpp"

#include "complementarity/islands.hpp"

namespace trammel::simulate {
void ImpactDirections::prepare(model::AssembledSystem& system, std::vector<TouchingContact>& touching) {
  std::vector<model::ContactDirection> directions;
  std::vector<complementarity::ContactPoint> points;
  normal.clear(), tangent.clear(), friction.clear();
  tangents = touching.empty() ? 0 : system.tangents(touching.front().contact);  // the same for all that strike
  for (TouchingContact& c : touching) {
    const model::ContactEntry& contact = system.model().contacts[c.contact];
    if (contact.friction) c.slip_before = system.slip(c.contact);
    normal.push_back(int(directions.size())), directions.push_back({c.contact, 0});
    tangent.push_back(contact.friction ? int(directions.size()) : -1);
    for (int k = 1; k <= tangents && contact.friction; ++k) directions.push_back({c.contact, k});
    points.push_back({.normal = normal.back(), .tangent = tangent.back(), .tangents = tangents});
  }
  system.impulse_response(directions, jump, A);
  take_islands(complementarity::island_of_each(points, A), touching);
  for (const TouchingContact& c : touching)
    friction.push_back(friction_in_impact(system.model().contacts[std::size_t(c.contact)], c, c.slip_before.norm()));
  rates.resize(A.rows());
  for (std::size_t i = 0; i < touching.size(); ++i) {
    rates[normal[i]] = touching[i].was_closed ? 0 : touching[i].before;
    if (tangent[i] >= 0) rates.segment(tangent[i], tangents) = touching[i].slip_before.head(tangents);
  }
}

}  // namespace trammel::simulate
