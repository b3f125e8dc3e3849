// The directions in which the contacts of an impact strike and rub, and how the system answers impulses along them.
//
//     dv = jump P,   change of the rates = A P        P [N s] along the normals, then the tangents of contacts with
//     friction
//
// A is the Delassus matrix, with bilateral rows held. Closed contacts have the rate 0: what theirs is beside it is
// round-off.
#pragma once

#include <vector>

#include "simulate/impact/impact_friction.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class ImpactDirections {
 public:
  // Of all that touch, at the system's point. Fills in `slip_before`, `island` and `speed`.
  void prepare(model::AssembledSystem& system, std::vector<TouchingContact>& touching);

  Mat jump, A;
  Vec rates;                         // [m/s] before the impact
  std::vector<int> normal, tangent;  // by contact: index of its normal and of its first tangent, -1 without friction
  std::vector<ImpactFriction> friction;
  int tangents = 1;
};

}  // namespace trammel::simulate
