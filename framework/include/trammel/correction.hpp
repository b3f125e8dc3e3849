// Corrections of constraint violation after a step; they work with every integrator.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class Correction : public Component {
 public:
  // Moves `state` (q or v) so that its part of the rows holds; the System is free to move. Applied in the order
  // position, velocity, energy, each at the result of the one before.
  virtual Outcome apply(System&, State& state) = 0;
};

}  // namespace trammel
