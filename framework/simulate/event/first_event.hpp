// The first event within a step, among functions whose event happened somewhere in it.
//
// Only those that precede the earliest one so far are located. A shortened step still has a length of at least 4 units
// in the last place of t, so every event advances time.
#pragma once

#include <vector>

#include "simulate/event/trial_steps.hpp"

namespace trammel::simulate {

struct Suspect {
  EventFunction* function;
  double high;            // [s] length of a step after which the event has happened
  ValueAndSlope at_high;  // the function there
  double about = 0;       // [s] estimate of the crossing
};
struct Located {
  EventFunction* function;
  double h;  // [s] length of the step to its event
};

double shortest_step(double t);  // [s] to an event

// The step of length h from time t has at least one suspect.
Located locate_first(std::vector<Suspect> suspects, double t, double h, StepsFromNow& steps);

}  // namespace trammel::simulate
