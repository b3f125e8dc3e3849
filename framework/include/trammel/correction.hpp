// Corrections of the constraint and energy errors that a step leaves; they work with every integrator.
//
// They are applied in the order position, velocity, energy, each to the result of the one before. Afterwards the
// framework solves for a and lambda at the corrected q and v and passes the result to Integrator::accept.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class Correction : public Component {
 public:
  enum class Level {
    position,  // moves q so that g(t, q) = 0
    velocity,  // moves v so that G v + g_t = 0, at the final q
    energy,    // moves v so that the energy agrees with the balance and G v + g_t does not change
  };
  struct Step {
    const State& now;          // start of the step
    const State& uncorrected;  // end of the step as the integrator gave it
    double energy;             // [J] required at the end by the balance: E_start + supplied - dissipated
  };

  virtual bool corrects(Level) const = 0;
  // Corrects q or v of `state`, which is the step's end on entry; may call System::move_to. A rejection ends the run.
  virtual Outcome apply(Level, System&, const Step&, State& state) = 0;

  // As Integrator::restart: the state jumped or sizes changed. Always called before the first step.
  virtual void restart(System&, const State& /*now*/) {}
  // Reads or writes the state that must survive a checkpoint.
  virtual void archive(Archive&) {}
};

// Ability of corrections that need the momentum of every body (HasMomentum in body.hpp). Scenes with a body without
// this ability are refused.
class NeedsMomentum {
 public:
  virtual ~NeedsMomentum();
  virtual bool needs_momentum() const = 0;  // called after `prepare`
};

}  // namespace trammel
