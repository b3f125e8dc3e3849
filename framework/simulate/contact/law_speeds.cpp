#include "simulate/contact/law_speeds.hpp"

#include <algorithm>

namespace trammel::simulate {

double capture_speed(const model::ContactEntry& contact, const Scale& scale) {
  const double named = contact.restitution->treatment().capture_speed;
  return named > 0 ? named : scale.least_speed();
}

// If friction is decided in every evaluation, no row holds a sticking contact: it may keep the rate that steps leave.
double stick_speed(const model::ContactEntry& contact, const Scale& scale) {
  const double named = contact.coulomb->stick_speed();
  const bool drifts = contact.coulomb->decide() == SetValuedFriction::Decide::every_evaluation;
  return std::max(scale.rest_speed(), named > 0 || !drifts ? named : scale.drift());
}

}  // namespace trammel::simulate
