// A scene's settings of the run itself: steps, times, records, corrections.
//
//     "integrator": {..., "step": 1e-4, "contact_step": {"tolerance": 1e-9}}     contact_step: while a contact is
//     closed
//     "simulate":   {"start": 0, "until": 2, "contact_hold": 0, "chatter_steps": 3, "event_limit": 1000000}
//     "initial":    "check" | "project" | "equilibrium", or {"consistent": "check" | "project"}
//     "static":     {"steps": 10, "tolerance": 1e-9, "iterations": 20, "arc_length": false}     for `trammel static`
//     "record":     {"every": 1e-3, "fields": [0.5, 1], "observe": {"tip_y": "beam.tip.y"}}
#pragma once

#include <limits>
#include <optional>
#include <vector>

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
  std::vector<double> field_times;  // [s] of pictures, ascending
  // [s] contact_step continues so long after an event, for flights within one visible bounce
  double contact_hold = 0;
  double chatter_steps = 3;         // a rebound that lasts fewer fixed steps sticks; 0: never
  long long event_limit = 1000000;  // in a thousandth of the run
  // Treatment of the state that the bodies' parameters give: checked against the joints, projected onto them, or moved
  // to rest (equilibrium.hpp).
  enum class Initial { check, project, equilibrium };
  Initial initial = Initial::check;

  int load_steps = 10;           // of statics, from start to until
  double load_tolerance = 1e-9;  // of what is left unbalanced, relative to the load
  int load_iterations = 20;      // of Newton's method before a load step is divided
  bool arc_length = false;       // the path may turn back in t
};

// The scene's integrator. Without one: dop853 with errors below 1e-9, unless another fits better
// (integrator_choice.hpp).
const scene::Value& integrator_entry(const scene::Value& root);

// A scene in motion, or equilibria one after another under loads that follow t (load_path.hpp).
enum class Purpose { motion, statics };
// The default purpose of a scene: statics if it has "static" and no "integrator".
Purpose purpose_of(const scene::Value& root);

// Reads all but the integrator's own parameters and the observables; every problem goes to `problems`.
Settings read_settings(const scene::Value& root, Purpose purpose, scene::Problems& problems);

}  // namespace trammel::simulate
