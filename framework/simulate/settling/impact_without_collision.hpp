// Rule 8 of contact_mode.hpp: impacts without collision, which end the slips of sliding contacts that have no finite
// forces (Painleve).
#pragma once

#include <vector>

#include "simulate/decision/mode_decision.hpp"
#include "simulate/results/contact_event.hpp"
#include "simulate/settling/contact_impacts.hpp"

namespace trammel::simulate {

class ImpactWithoutCollision {
 public:
  ImpactWithoutCollision(const ContactScene& scene, ContactsAtEvent& at, ContactImpacts& impacts,
                         ModeDecision& decision)
      : scene_(scene), at_(at), impacts_(impacts), decision_(decision) {}

  // v jumps, and modes are decided. Appends the events of all impacts at this instant but the last. Ends the run if
  // there are neither such impacts nor other forces.
  [[nodiscard]] complementarity::ContactSolution strike(State& state, const ContactChanges& changes, bool jumped,
                                                        std::vector<ContactEvent>& events);

 private:
  [[nodiscard]] complementarity::ContactSolution end_slowest_slips(State& state, const ContactChanges& changes,
                                                                   bool jumped);
  [[nodiscard]] complementarity::ContactSolution strike_raised(State& state, const ContactChanges& changes,
                                                               double raised);
  [[nodiscard]] complementarity::ContactSolution decide_at_once(State& state, const ContactChanges& changes,
                                                                bool jumped);
  [[nodiscard]] complementarity::ContactSolution decide_otherwise(const State& state, const ContactChanges& changes);
  bool slides(int contact, bool jumped) const;
  void find_approaches(double slip);

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  ContactImpacts& impacts_;
  ModeDecision& decision_;
};

}  // namespace trammel::simulate
