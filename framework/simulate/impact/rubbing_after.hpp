// Friction of joints' bearings right after an impact of contacts that knows none: what the energetic and Poisson's law
// leave to it.
//
// The loads are those of both impacts together (bearing_impulses.hpp). Every gap comes in with the rate that the impact
// left it, also where it opened a contact that was closed. Contacts that friction presses again give way without
// restitution, so this takes energy only: with F its impulses, u its rates at the end, the change is F . u - F
// . A F/2, where N u_n = 0 and T . u_t <= 0.
#pragma once

#include <vector>

#include "simulate/impact/bearing_impulses.hpp"
#include "simulate/impact/impact.hpp"

namespace trammel::simulate {

class RubbingAfter {
 public:
  // `touching` and `dv` come in as the impact leaves them, with the joints that rub. The system is at `state`, before
  // the impact.
  [[nodiscard]] complementarity::ContactSolution solve(model::AssembledSystem& system, const State& state,
                                                       double at_rest, std::vector<TouchingContact>& touching, Vec& dv);

 private:
  ContactProblem problem_;
  BearingImpulses bearings_;
};

}  // namespace trammel::simulate
