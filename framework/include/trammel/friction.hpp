// Friction laws: the tangential force of a contact, given the normal force F_n >= 0 [N].
//
//     s [m/s] slip velocity of A over B in the contact's tangents; slip = |s| >= 0
//
// A law derives from exactly one of the two classes, as a contact law does.
#pragma once

#include <trammel/component.hpp>

namespace trammel {

// A force that is smooth in the slip velocity: F_t = -ratio(|s|) F_n s/|s|. The contact never sticks; it creeps
// instead.
class SmoothFriction : public Component {
 public:
  virtual double ratio(double slip) const = 0;  // F_t/F_n; 0 at slip = 0, so that the force has no jump
  virtual double slope(double slip) const = 0;  // its derivative [s/m]
};

// Coulomb's set-valued law: the contact sticks by constraint rows while |F_t| <= mu_0 F_n; otherwise it slides with
// F_t = -mu(|s|) F_n s/|s|. This force is proportional to the multiplier of the gap's row, which makes W != G.
class SetValuedFriction : public Component {
 public:
  enum class Decide {
    at_events,         // stick and slide change at located events and are fixed between them
    every_evaluation,  // decided in each evaluation; needs a compliant contact and an explicit method
  };
  virtual double static_coefficient() const = 0;              // mu_0
  virtual double kinetic_coefficient(double slip) const = 0;  // mu(|s|) <= mu_0
  virtual Decide decide() const = 0;
  // [m/s] The contact sticks below this slip. 0: chosen from the scene: at the level of round-off for `at_events`,
  // otherwise at the rates that steps leave in directions that are held.
  virtual double stick_speed() const = 0;
};

}  // namespace trammel
