// What steps of any length from the present state show of an event function: the event is located by repeating the step
// with other lengths, so to the accuracy of the method itself.
#pragma once

#include "run/contact_scale.hpp"
#include "simulate/event/event_values.hpp"

namespace trammel::simulate {

// Thrown: the integrator refused one of these steps.
struct StepRefused {};

class StepsFromNow {
 public:
  virtual ~StepsFromNow() = default;
  virtual ValueAndSlope at(EventFunction& function, double h) = 0;     // at the end of a step of length h
  virtual double force_slope(EventFunction& function, double dt) = 0;  // there, by a difference over dt
  virtual double gap_acceleration(const EventFunction& function) = 0;  // now
  virtual Scale scale(const EventFunction& function) const = 0;

  // True if the function shows that its event happened before `end`. Just after an event, a function at the round-off
  // of 0 proves nothing unless it falls on, faster than an impact may have left it: the same impact would follow
  // without end. A function that began below 0 (a drifted row, an onset that was not located) proves nothing unless it
  // falls further.
  bool happened(const EventFunction& function, const ValueAndSlope& end);
};

// By an integrator.
class TrialSteps : public StepsFromNow {
 public:
  TrialSteps(model::AssembledSystem& system, Integrator& integrator, EventValues& values, const ContactScale& scale)
      : system_(system), integrator_(integrator), values_(values), scale_(scale) {}

  void start_at(const State& now) { now_ = &now, h_ = 0; }  // `now` stays as it is as long as steps are tried
  ValueAndSlope at(EventFunction& function, double h) override;
  double force_slope(EventFunction& function, double dt) override;
  double gap_acceleration(const EventFunction& function) override;
  Scale scale(const EventFunction& function) const override { return scale_.of(function.contact); }
  void take(double h, State& next);  // fills next
  long long count = 0;

 private:
  model::AssembledSystem& system_;
  Integrator& integrator_;
  EventValues& values_;
  const ContactScale& scale_;
  const State* now_ = nullptr;
  double h_ = 0;  // [s] of the last one, to trial_; 0: none
  State trial_;
};

}  // namespace trammel::simulate
