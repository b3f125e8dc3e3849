// Rule 11 of contact_mode.hpp: modes that this instant leaves in doubt are those of the state a moment later.
#pragma once

#include <vector>

#include "simulate/decision/instant_decision.hpp"

namespace trammel::simulate {

class WhatFollows {
 public:
  WhatFollows(const ContactScene& scene, ContactsAtEvent& at, InstantDecision& instant)
      : scene_(scene), at_(at), instant_(instant) {}

  // `asked`: contacts whose modes are in doubt. `so_far`: the solution of this instant, which stays if no later state
  // decides.
  [[nodiscard]] complementarity::ContactSolution decide(const State& state, ContactChanges changes, bool jumped,
                                                        const std::vector<bool>& asked,
                                                        complementarity::ContactSolution so_far);

 private:
  double time_of_change(const std::vector<bool>& asked, const Vec& a) const;
  std::vector<bool> with_their_islands(std::vector<bool> asked) const;

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  InstantDecision& instant_;
};

}  // namespace trammel::simulate
