// Corrections of what a step leaves violated (rows, energy); they work with every integrator.
//
// Applied in the order position, velocity, energy, each to the result of the one before. Afterwards the framework solves
// a and lambda anew at the corrected q and v and hands the result to Integrator::accept.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class Correction : public Component {
 public:
  struct Step {
    const State& now;          // where it began
    const State& uncorrected;  // where the integrator ended
    double energy;             // [J] what the balance says at its end: E_start + supplied - dissipated
  };

  // Moves q and v of `state`, which comes in as the step's end; the System is free to move. A rejection ends the run.
  // (Scaling v to meet the energy keeps G v + g_t = 0 only where g_t = 0: no row is moved by time.)
  virtual Outcome apply(System&, const Step&, State& state) = 0;

  // Something jumped, or sizes changed: as for Integrator. Always called before the first step.
  virtual void restart(System&, const State& /*now*/) {}
  // What must survive a checkpoint.
  virtual void archive(Archive&) {}
};

}  // namespace trammel
