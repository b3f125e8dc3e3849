// The directions in which the contacts of an impact strike and rub, and the response of the system to impulses along
// them.
//
//     dv = jump P,   change of the rates = A P        P [N s] along the normals, then the tangents of contacts with
//     friction
//
// A is the Delassus matrix, with bilateral rows held. The rates of closed contacts are set to 0: they are round-off and
// drift.
#pragma once

#include <vector>

#include "simulate/impact/impact_friction.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

class ImpactDirections {
 public:
  // For all contacts that touch, at the system's point. Sets their `slip_before`, `island` and `speed`.
  void prepare(model::AssembledSystem& system, std::vector<TouchingContact>& touching);

  Mat jump, A;
  Vec rates;                         // [m/s] before the impact
  std::vector<int> normal, tangent;  // by contact: index of its normal and of its first tangent, -1 without friction
  std::vector<ImpactFriction> friction;
  int tangents = 1;
};

}  // namespace trammel::simulate
