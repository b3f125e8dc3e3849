// The modes that contacts have after an event, by their forces: at that instant, and where it leaves modes in doubt, by
// what follows (rules 3 to 7 and 10 to 15 of contact_mode.hpp).
#pragma once

#include <vector>

#include "simulate/decision/instant_decision.hpp"
#include "simulate/decision/what_follows.hpp"

namespace trammel::simulate {

class ModeDecision {
 public:
  ModeDecision(const ContactScene& scene, ContactsAtEvent& at)
      : scene_(scene), at_(at), instant_(scene, at), what_follows_(scene, at, instant_) {}

  // Sets at.modes; v changes where a drift ends. If there is no solution, an impact without collision follows (rule 8).
  [[nodiscard]] complementarity::ContactSolution decide(State& state, const ContactChanges& changes, bool jumped);
  InstantDecision& instant() { return instant_; }
  const InstantDecision& instant() const { return instant_; }
  WhatFollows& what_follows() { return what_follows_; }

 private:
  [[nodiscard]] complementarity::ContactSolution open_freed(State& state, const ContactChanges& changes, bool jumped,
                                                            const complementarity::ContactSolution& so_far);
  bool changes_sign_by_infinity(const State& state, const ContactChanges& changes) const;
  std::vector<bool> in_doubt(const std::vector<int>& released) const;

  const ContactScene& scene_;
  ContactsAtEvent& at_;
  InstantDecision instant_;
  WhatFollows what_follows_;
};

}  // namespace trammel::simulate
