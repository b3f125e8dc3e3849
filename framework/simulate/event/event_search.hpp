// Which event functions have been 0 within a step. This shows in four ways: the function is negative at the step's end;
// it is positive at both ends and negative between them (the cubic through values and slopes of both ends shows where
// to look); or, just after an event that left it at the round-off of 0, the parabola at its start returns to 0 within
// the step; or a slip without a direction has lasted too long (UndirectedSlip).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "simulate/event/first_event.hpp"

namespace trammel::simulate {

// Looks where the cubic between the ends is lowest, or has a kink, and refines it by what it finds there: the function
// may be negative within the step and not at its ends. `dt`: for slopes of forces.
std::optional<Suspect> find_dip(EventFunction& function, numerics::Cubic between, bool may_have_kink, double dt,
                                StepsFromNow& steps);
// A gap that an event has just left at 0 with rate u and acceleration A < 0 closes again after about -2 u/A, within h.
std::optional<Suspect> find_return(EventFunction& function, double h, StepsFromNow& steps);

class EventSearch {
 public:
  EventSearch(model::AssembledSystem& system, EventValues& values, StepsFromNow& steps)
      : system_(system), values_(values), steps_(steps) {}

  struct Shown {
    std::vector<Suspect> within;         // to be located
    std::vector<EventFunction*> at_end;  // events of the end of the step
  };
  Shown look(const ExaminedStep& step, std::span<EventFunction> functions);

 private:
  bool fell(const EventFunction& function) const;
  bool stalls(const ExaminedStep& step, const EventFunction& function);
  std::optional<Suspect> dip(const ExaminedStep& step, std::span<EventFunction> functions);
  void fill_slopes(const ExaminedStep& step, std::span<EventFunction> functions,
                   std::optional<double> EventFunction::*where, const State& state, double dt);

  model::AssembledSystem& system_;
  EventValues& values_;
  StepsFromNow& steps_;
};

}  // namespace trammel::simulate
