// What a scene says about the run itself: steps, times, records, corrections.
//
//     "integrator": {..., "step": 1e-4, "contact_step": {"tolerance": 1e-9}}     contact_step: while a contact is closed
//     "simulate":   {"start": 0, "until": 2, "contact_hold": 0, "chatter_steps": 3, "event_limit": 1000000}
//     "initial":    "check" | "project" | "equilibrium", or {"consistent": "check" | "project"}
//     "record":     {"every": 1e-3, "observe": {"tip_y": "beam.tip.y"}}
#pragma once

#include <limits>
#include <optional>

#include <trammel/integrator.hpp>

#include "scene/value.hpp"

namespace trammel::simulate {

// One "step" of a scene: a length, or an error to keep.
struct StepChoice {
  std::optional<double> fixed;  // [s]
  Tolerance tolerance;
  double initial = 0;                                     // [s] first trial; 0: chosen
  double least = 0;                                       // [s] below it the run fails; 0: what round-off of t leaves
  double most = std::numeric_limits<double>::infinity();  // [s]
};

struct Settings {
  StepChoice step, contact_step;
  bool own_contact_step = false;    // the scene gives contact_step
  double start = 0, until = 0;      // [s]
  double every = 0;                 // [s] between records
  double contact_hold = 0;          // [s] contact_step goes on so long after an event: the flights within a bounce
  double chatter_steps = 3;         // a rebound that lasts fewer fixed steps sticks; 0: never
  long long event_limit = 1000000;  // in a thousandth of the run
  // What is done with the state that the bodies' parameters give: nothing, if it satisfies the joints; moved onto them; moved
  // to rest (equilibrium.hpp).
  enum class Initial { check, project, equilibrium };
  Initial initial = Initial::check;
};

// What the scene says of its integrator. Without a word: dop853 with errors below 1e-9, which needs no step to be chosen and
// locates contacts and friction as events.
const scene::Value& integrator_entry(const scene::Value& root);

// Reads all but the integrator's own parameters and the observables; every problem goes to `problems`.
Settings read_settings(const scene::Value& root, scene::Problems& problems);

}  // namespace trammel::simulate
