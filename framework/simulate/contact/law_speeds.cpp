#include "simulate/contact/law_speeds.hpp"

#include <algorithm>

namespace trammel::simulate {

double capture_speed(const model::ContactEntry& contact, const Scale& scale) {
  const double named = contact.restitution->treatment().capture_speed;
  return named > 0 ? named : scale.slow();
}

// Where every evaluation decides, no row holds what sticks: it may have what steps leave of rates.
double stick_speed(const model::ContactEntry& contact, const Scale& scale) {
  const double named = contact.coulomb->stick_speed();
  const bool drifts = contact.coulomb->decide() == SetValuedFriction::Decide::every_evaluation;
  return std::max(scale.at_rest(), named > 0 || !drifts ? named : scale.drift());
}

}  // namespace trammel::simulate
