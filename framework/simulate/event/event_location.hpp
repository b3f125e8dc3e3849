// Finds the first event of a contact inside a trial step, and shortens the step to it.
//
// A controlled step is refused if it is too long to show events (StepResolution), or if forces pass infinity in it. For
// sliding contacts this need not show at the ends of the step, but the determinant of their equations changes its sign
// there, where it is known (AssembledSystem::find_signs). Contacts that do not act on each other have determinants of
// their own.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "linear/dense/block_signs.hpp"
#include "run/contact_scale.hpp"
#include "simulate/contact/contact_changes.hpp"
#include "simulate/event/event_search.hpp"
#include "simulate/event/step_resolution.hpp"
#include "simulate/settling/contact_mode.hpp"

namespace trammel::simulate {

class EventLocation {
 public:
  EventLocation(model::AssembledSystem& system, Integrator& integrator, ContactModes& modes, const ContactScale& scale);

  bool has_contacts() const { return !system_.model().contacts.empty(); }
  void restart(const State& now);  // modes or state changed

  // Fixed steps are taken whatever they hide. A controlled one is refused if forces pass infinity in it, and, unless
  // hardly any shorter one is left, if it is too long to show events.
  enum class Steps { fixed, controlled, nearly_shortest };
  enum class Found { nothing, event, step_refused, step_too_long, passes_infinity, not_finite };
  // Examines the trial now -> next over h. Found::event: h and next are shortened to the event, `changes` are the
  // changes there. With Found::nothing they may be shortened too, to where a gap only touches (mark_grazes).
  // Found::not_finite: a gap or a force at next is not finite, though the state may be (a law of time that ended under
  // a body). next must not be accepted after Found::step_too_long (Steps::controlled only) and Found::passes_infinity
  // (not Steps::fixed).
  Found examine(const State& now, double& h, State& next, Steps steps);
  const ContactChanges& changes() const { return changes_; }
  // [s] Limit of the next step: `swings` (longest_step_in_contact), or more if every closed contact slides so fast
  // that a longer step takes at most a quarter of its slip, which then has no zero to pass over.
  double longest_step(double swings) const;
  long long steps_tried() const { return trials_.count; }
  void accept(double h, const State& next);  // next became the solution

  void archive(Archive& a);

 private:
  Found locate(const State& now, double& h, State& next, Steps steps);
  void evaluate(ValueAndSlope EventFunction::*where, const State& state, numerics::BlockSigns& signs);
  bool passes_infinity(Steps steps) const { return steps != Steps::fixed && any_opposite(signs_, signs_next_); }
  void set_up_functions();
  void measure_undirected_slips(double h, const State& next);

  model::AssembledSystem& system_;
  ContactModes& modes_;
  const ContactScale& scale_;
  EventValues values_;
  TrialSteps trials_;
  EventSearch search_;
  StepResolution resolution_;
  std::vector<EventFunction> functions_;
  std::vector<model::ContactMode> modes_before_;  // of functions_, with the directions of slips after the last step
  numerics::BlockSigns signs_, signs_next_;       // at the ends of the step; none where no forces were needed
  double h_before_ = 0;                           // [s] 0: no step yet since the last change
  ContactChanges changes_;
};

}  // namespace trammel::simulate
