// Ability of integrators whose steps are longer than the oscillations in them: inside such a step the motion is not
// close to the cubic Hermite polynomial through the ends. Contact events and the energy ledger use the integrator's
// dense output, which should therefore need no evaluation of the system. Near an event, a controlled step is shortened
// until it resolves the oscillations. Controlled step sizes are kept constant, so that errors of unresolved
// oscillations do not accumulate.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class OscillatingSteps : public DenseOutput {
 public:
  ~OscillatingSteps() override;
  virtual double swing() const = 0;  // [rad/s] highest frequency that the step does not resolve; 0: none

  // A quadrature along the step from `now` to `next`. Its points, both ends included, are points where the method has
  // evaluated the system, so that powers are integrated without further evaluations. Fills t, q, v and lambda at point
  // i and returns its weight [s].
  virtual int quadrature_points() const = 0;
  virtual double evaluated(System& s, const State& now, const State& next, int i, State& at) = 0;
};

}  // namespace trammel
