// Ability of integrators with tolerances of their own as parameters: an absolute one that the scene leaves out is meant
// in the scene's unit of length, as that of the Simulator's error control is.
#pragma once

namespace trammel {

class OwnTolerances {
 public:
  virtual ~OwnTolerances();
  // [m] The scene's length at its start, 1 at most; called once, before the first `restart`. Tests that make a method
  // without a scene leave it out: 1.
  virtual void in_unit(double length) = 0;
};

}  // namespace trammel
