#include "simulate/impact/impact_friction.hpp"

#include <algorithm>

namespace trammel::simulate {
namespace {

// The speed with which a contact begins an impact.
double speed_of(const TouchingContact& c) {
  if (c.without_collision) return c.slip_before.norm();
  return c.was_closed ? 0 : std::max(0.0, -c.before);
}

}  // namespace

ImpactFriction friction_in_impact(const model::ContactEntry& contact, const TouchingContact& c, double slip) {
  ImpactFriction friction;
  if (contact.coulomb)
    friction = {contact.coulomb->static_coefficient(), contact.coulomb->kinetic_coefficient(slip)};
  else if (contact.smooth)
    friction.mu_0 = friction.mu = contact.smooth->ratio(std::max(slip, c.speed));
  friction.mu_0 *= 1 + c.raised;
  friction.mu *= 1 + c.raised;
  return friction;
}

void take_islands(const std::vector<std::size_t>& islands, std::vector<TouchingContact>& touching) {
  std::vector<double> fastest(touching.size(), 0);  // by island
  for (std::size_t i = 0; i < touching.size(); ++i) {
    touching[i].island = islands[i];
    fastest[islands[i]] = std::max(fastest[islands[i]], speed_of(touching[i]));
  }
  for (TouchingContact& c : touching) c.speed = fastest[c.island];
}

}  // namespace trammel::simulate
