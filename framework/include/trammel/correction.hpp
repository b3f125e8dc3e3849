// Corrections of what a step leaves violated; they work with every integrator.
//
// Applied in the order position, velocity, energy, each to the result of the one before. Afterwards the framework solves
// a and lambda anew at the corrected q and v and hands the result to Integrator::accept.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class Correction : public Component {
 public:
  enum class Level {
    position,  // moves q so that g(t, q) = 0
    velocity,  // moves v so that G v + g_t = 0, at a q that is final
    energy,    // moves v so that the energy is what the balance says, and G v + g_t stays
  };
  struct Step {
    const State& now;          // where it began
    const State& uncorrected;  // where the integrator ended
    double energy;             // [J] what the balance says at its end: E_start + supplied - dissipated
  };

  virtual bool corrects(Level) const = 0;
  // Moves q or v of `state`, which comes in as the step's end; the System is free to move. A rejection ends the run.
  virtual Outcome apply(Level, System&, const Step&, State& state) = 0;

  // Something jumped, or sizes changed: as for Integrator. Always called before the first step.
  virtual void restart(System&, const State& /*now*/) {}
  // What must survive a checkpoint.
  virtual void archive(Archive&) {}
};

}  // namespace trammel
