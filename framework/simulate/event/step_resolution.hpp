// Whether a controlled step is too long to show events.
//
// Error control sees the effect of time on event functions only through the motion: it sees none where everything is
// held, or where a table shakes under a ball in flight. Therefore a controlled step is too long if a function departs
// so far from the form assumed in the search (EventSearch) that it could have crossed 0 unseen. Gaps are compared with
// their cubic at irrational parts of the step, forces with their tangent one step ahead. A jump of a law of time leaves
// a difference that steps too short to matter pass over.
#pragma once

#include <vector>

#include "run/contact_scale.hpp"
#include "simulate/event/event_values.hpp"
#include "system/between_states.hpp"

namespace trammel::simulate {

class StepResolution {
 public:
  StepResolution(model::AssembledSystem& system, Integrator& integrator, EventValues& values, const ContactScale& scale)
      : system_(system), values_(values), scale_(scale), between_states_(system, integrator) {}

  void restart() { longest_ = 0; }
  bool hides(const ExaminedStep& step, std::vector<EventFunction>& functions);
  // As EventLocation::longest_step.
  double longest_step(const std::vector<EventFunction>& functions, double h_before, double swings) const;
  void archive(Archive& a) { a("longest", longest_); }

 private:
  bool slip_hides(const ExaminedStep& step, const EventFunction& function);
  bool hides_motion(const ExaminedStep& step, const std::vector<EventFunction>& functions);
  bool hides_force(const ExaminedStep& step, std::vector<EventFunction>& functions);
  double resolution_of_motion(const EventFunction& function) const;
  double resolution_of_force(const EventFunction& function);

  model::AssembledSystem& system_;
  EventValues& values_;
  const ContactScale& scale_;
  BetweenStates between_states_;
  State between_;
  double longest_ = 0;  // [s] longest step tried since the last change
};

}  // namespace trammel::simulate
