// Rule 15 of contact_mode.hpp: contacts at rest press no more than springs do, which bounds their friction. Sets the
// springs of at.modes.
#pragma once

#include <map>
#include <vector>

#include "simulate/verdicts/forces_in_modes.hpp"

namespace trammel::simulate {

class SpringBounds {
 public:
  SpringBounds(const ContactScene& scene, ContactsAtEvent& at, ContactProblem& problem, ForcesInModes& forces)
      : system_(scene.system), at_(at), problem_(problem), forces_(forces) {}

  void restart() { rounds_ = 0; }           // before a decision
  bool any() const { return rounds_ > 0; }  // in this decision
  // True if the bounds of friction have changed: all modes are to be decided again. If the bounds come to no end, none
  // is kept. `held` are at their bounds beside sliding ones (rule 12).
  bool bound_by_springs(const State& state, const std::vector<Participant*>& held);

 private:
  void take_springs_before();
  bool came_to_rest(const model::SharedRows& group) const;
  bool take_springs_of_sliding();
  std::map<int, model::Carried> carried_by_springs(const std::vector<Participant*>& held);
  model::Carried carried_in_modes(int contact);

  model::AssembledSystem& system_;
  ContactsAtEvent& at_;
  ContactProblem& problem_;
  ForcesInModes& forces_;
  int rounds_ = 0;
  std::vector<Participant> without_bounds_;     // before the first of these rounds
  std::vector<model::Modes> modes_so_bounded_;  // decided in these rounds
};

}  // namespace trammel::simulate
