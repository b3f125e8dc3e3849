// The map of a state from old coordinates to new ones (a refined mesh). A refined body creates its transfer; the
// framework combines the transfers of all bodies, with the identity for bodies that did not change.
#pragma once

#include <trammel/types.hpp>

namespace trammel {

class Transfer {
 public:
  virtual ~Transfer();
  // Maps the configuration: rotations unchanged, flat parts by an affine map, which is exact if the new coordinates can
  // represent the old shape. `fresh` has its new size on entry.
  virtual void q(In old, Out fresh) const = 0;
  // Maps tangent vectors (velocities, accelerations, increments) by the linear part of the same map. Forces are dual to
  // them and must be evaluated again.
  virtual void v(In old, Out fresh) const = 0;
};

}  // namespace trammel
