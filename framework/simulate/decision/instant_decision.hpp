// The modes of contacts at one instant by the forces there: rules 3 to 7, and 10 and 12 to 15 with them
// (contact_mode.hpp).
#pragma once

#include <vector>

#include "simulate/decision/bearing_decision.hpp"
#include "simulate/decision/participants.hpp"
#include "simulate/verdicts/modes_by_forces.hpp"

namespace trammel::simulate {

class InstantDecision {
 public:
  InstantDecision(const ContactScene& scene, ContactsAtEvent& at)
      : scene_(scene),
        at_(at),
        participants_(scene, at),
        by_forces_(scene, at, problem_),
        bearings_(scene, at, problem_, by_forces_) {}

  // Sets at.modes; v changes where a drift ends. `nearby` as in ContactProblem::solve. The contact `without` is no
  // candidate.
  [[nodiscard]] complementarity::ContactSolution decide(State& state, ContactChanges changes, bool jumped,
                                                        const std::vector<Participant>& nearby = {}, int without = -1);
  void gather(const Occasion& now, int without = -1);  // only finds who would take part

  // Of the last decision.
  const ContactProblem& problem() const { return problem_; }
  const std::vector<int>& candidates() const { return candidates_; }
  ForcesInModes& forces() { return by_forces_.forces(); }
  const Verdicts& verdicts() const { return by_forces_.verdicts(); }
  bool bearings_undecided() const { return bearings_.undecided(); }
  double least_acceleration(int contact) const { return participants_.least_acceleration(contact); }

 private:
  const ContactScene& scene_;
  ContactsAtEvent& at_;
  Participants participants_;
  ContactProblem problem_;
  ModesByForces by_forces_;
  BearingDecision bearings_;
  std::vector<int> candidates_;
};

}  // namespace trammel::simulate
