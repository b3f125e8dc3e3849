// Rule 12 of contact_mode.hpp: contacts at rest that keep the friction of their bound, like one that slides.
#pragma once

#include <vector>

#include "simulate/verdicts/forces_in_modes.hpp"

namespace trammel::simulate {

class HeldAtBounds {
 public:
  HeldAtBounds(const ContactScene& scene, ContactsAtEvent& at, ContactProblem& problem, ForcesInModes& forces)
      : scene_(scene), at_(at), problem_(problem), forces_(forces) {}

  // The contacts at rest whose friction is at its bound in a group that cannot carry its resultant, or whose sliding
  // members move or press otherwise than in the solution.
  std::vector<Participant*> find(const State& state);
  static bool let_go(const std::vector<Participant*>& held);  // where mu < mu_0; true if any does
  void keep(Participant& p);                                  // it keeps T = mu N, as if it slid

 private:
  const ContactScene& scene_;
  ContactsAtEvent& at_;
  ContactProblem& problem_;
  ForcesInModes& forces_;
};

}  // namespace trammel::simulate
