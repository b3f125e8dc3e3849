// Friction laws: what a contact does in the tangential direction, given the normal force F_n >= 0 [N].
//
//     s [m/s] slip velocity of A over B in the contact's tangents; slip = |s| >= 0
//
// A law derives from exactly one of the two, as a contact law does.
#pragma once

#include <trammel/component.hpp>

namespace trammel {

// A force, smooth in the slip velocity: F_t = -ratio(|s|) F_n s/|s|. It sticks nowhere, it creeps.
class SmoothFriction : public Component {
 public:
  virtual double ratio(double slip) const = 0;  // F_t/F_n; 0 at slip = 0, so that the force has no jump
  virtual double slope(double slip) const = 0;  // its derivative [s/m]
};

// Coulomb's set-valued law: rows hold the contact while |F_t| <= mu_0 F_n; else it slides with F_t = -mu(|s|) F_n s/|s|, a
// force that follows the row of the gap and so makes W != G.
class SetValuedFriction : public Component {
 public:
  enum class Decide {
    at_events,         // stick or slide changes at located events, and is fixed between them
    every_evaluation,  // its force anew at each evaluation; needs a compliant contact, an explicit method
  };
  virtual double static_coefficient() const = 0;              // mu_0
  virtual double kinetic_coefficient(double slip) const = 0;  // mu(|s|) <= mu_0
  virtual Decide decide() const = 0;
  virtual double stick_speed() const = 0;  // [m/s] slower sticks at a touch; 0: round-off only, right at events
};

}  // namespace trammel
