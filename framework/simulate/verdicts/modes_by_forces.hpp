// The modes of contacts by the forces of one problem: verdicts on the forces found, then what contacts share (rules 12
// to 15 of contact_mode.hpp).
#pragma once

#include <vector>

#include "simulate/verdicts/forces_in_modes.hpp"
#include "simulate/verdicts/held_at_bounds.hpp"
#include "simulate/verdicts/idle_contacts.hpp"
#include "simulate/verdicts/spring_bounds.hpp"
#include "simulate/verdicts/verdicts.hpp"

namespace trammel::simulate {

class ModesByForces {
 public:
  ModesByForces(const ContactScene& scene, ContactsAtEvent& at, ContactProblem& problem);

  void restart() { springs_.restart(); }  // before a decision
  // Solves the problem, and sets at.modes if it has a solution. `nearby` as in ContactProblem::solve.
  [[nodiscard]] complementarity::ContactSolution solve(const State& state, const std::vector<Participant>& nearby = {});
  // Afterwards. False if a contact lets go or a bound has changed: the problem is to be solved again.
  [[nodiscard]] bool share_within_bounds(const State& state);
  bool bounded_by_springs() const { return springs_.any(); }

  ForcesInModes& forces() { return forces_; }
  const Verdicts& verdicts() const { return verdicts_; }

 private:
  void share_forces_found(const State& state);

  ContactsAtEvent& at_;
  ContactProblem& problem_;
  ForcesInModes forces_;
  Verdicts verdicts_;
  IdleContacts idle_;
  HeldAtBounds bounds_;
  SpringBounds springs_;
};

}  // namespace trammel::simulate
