// Friction in joints directly after an impact by the energetic or Poisson's law, which do not contain it.
//
// The loads are those of both impacts together (bearing_impulses.hpp). Every gap starts with the rate that the impact
// left, also of closed contacts that the impact opened. Contacts that friction presses again yield without restitution,
// so this only takes energy: with its impulses F and the rates u at the end, the change is F . u - F . A F/2, where N
// u_n = 0 and T . u_t <= 0.
#pragma once

#include <vector>

#include "simulate/impact/bearing_impulses.hpp"
#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

class RubbingAfter {
 public:
  // On entry `touching` and `dv` are the result of the impact and include the joints with friction. The system is at
  // `state`, before the impact.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system, const State& state,
                                                       double at_rest, std::vector<TouchingContact>& touching, Vec& dv);

 private:
  ContactProblem problem_;
  BearingImpulses bearings_;
};

}  // namespace trammel::simulate
