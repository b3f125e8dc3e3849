// Values of event functions at a point of the system.
//
// Forces come from the equations of motion at the point. Methods that satisfy neither position nor velocity rows work
// on the level of accelerations: there lambda itself, with their stabilisation, is that force.
#pragma once

#include <vector>

#include <trammel/integrator.hpp>

#include "run/contact_scale.hpp"
#include "simulate/event/event_function.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// A trial from `now` to `next`.
struct ExaminedStep {
  const State& now;
  double h;
  const State& next;
  double h_before;  // [s] the step that led to `now`; 0: none yet since the last change
};

class EventValues {
 public:
  EventValues(model::AssembledSystem& system, const Integrator& integrator, const ContactScale& scale);

  void move_to(const State& state);
  // At `state`, to which the system was moved.
  ValueAndSlope at(EventFunction& function, const State& state);
  // Fills `where` of all functions; true if the equations of motion were solved for them.
  bool fill(std::vector<EventFunction>& functions, ValueAndSlope EventFunction::*where, const State& state);
  // At the system's point: slip along its direction; the value alone of a gap [m] or slip [m/s].
  ValueAndSlope slip(int contact, const Vec& a);
  double gap_or_slip(const EventFunction& function);
  // [m/s^2] Of a function that is a gap, or minus a gap.
  double gap_acceleration(const EventFunction& function, const State& state);
  // [N/s] By a difference over dt, from the state extrapolated by its velocity and acceleration.
  std::vector<double> force_slopes(const std::vector<EventFunction*>& functions, const State& state, double dt);
  // After `fill` at this state, if functions include forces.
  const Vec& forces(const State& state) const { return own_force_ ? state.lambda : lambda_; }

 private:
  double force(EventFunction& function, double t, const Vec& lambda);

  model::AssembledSystem& system_;
  const ContactScale& scale_;
  bool own_force_;            // the integrator's lambda is the force of the contact
  bool accelerated_ = false;  // a_ and lambda_ are those of the point
  Vec a_, lambda_, dq_;
  State moved_;
};

}  // namespace trammel::simulate
