// Friction laws: what a contact does in the tangential direction, given the normal force.
#pragma once

#include <variant>

#include <trammel/component.hpp>

namespace trammel {

// F_t = -mu(|s|) F_n s/|s|: a force, smooth in the slip velocity s [m/s].
struct Regularised {
  double coefficient = 0;        // mu
  double critical_velocity = 0;  // [m/s] where mu is reached
};

// F_t in the cone of mu_0 F_n while sticking (rows), -mu F_n s/|s| while slipping (a force that may couple rows: W !=
// G).
struct Coulomb {
  double static_coefficient = 0;   // mu_0
  double kinetic_coefficient = 0;  // mu <= mu_0
};

class Friction : public Component {
 public:
  virtual std::variant<Regularised, Coulomb> law() const = 0;
};

}  // namespace trammel
