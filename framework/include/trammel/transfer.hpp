// How a state moves from old coordinates to those that replaced them (a refined mesh). A body makes its own; the framework
// joins them to one of the whole system, bodies that did not change passed through.
#pragma once

#include <trammel/types.hpp>

namespace trammel {

class Transfer {
 public:
  virtual ~Transfer();
  // Configuration. Rotations are passed through as they are; flat parts by an affine map, exact where the old shape can
  // be said in the new coordinates. `fresh` comes in with its new size.
  virtual void q(In old, Out fresh) const = 0;
  // What lives in the tangent space (velocities, accelerations, increments), by the linear part of the same map. Not for
  // forces, which are dual to it: they are evaluated anew.
  virtual void v(In old, Out fresh) const = 0;
};

}  // namespace trammel
