// Ability of integrators with tolerances of their own as parameters. An absolute tolerance that the scene leaves out is
// relative to the scene's length, like that of the Simulator's error control.
#pragma once

namespace trammel {

class OwnTolerances {
 public:
  virtual ~OwnTolerances();
  // [m] The scene's length at its start, at most 1; called once, before the first `restart`. Not called (length 1)
  // where tests make a method without a scene.
  virtual void in_unit(double length) = 0;
};

}  // namespace trammel
