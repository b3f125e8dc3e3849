// An ability of integrators whose steps are longer than the swings in them: between its ends a step is not near the cubic
// through v and a there. Whoever looks into such a step (events of contacts, the ledger of energies) asks the integrator, so
// its dense output should cost no evaluation; near an event a controlled step is shortened until it resolves the swings. Controlled
// steps are kept even: what they do not resolve then does not add up.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class OscillatingSteps : public DenseOutput {
 public:
  ~OscillatingSteps() override;
  virtual double swing() const = 0;  // [rad/s] the fastest that it does not resolve; 0: none

  // A quadrature along the step from `now` to `next` whose points, both ends among them, are those of its own evaluations, so
  // that powers are integrated without another: fills t, q, v and lambda at its i-th point, and gives the weight [s].
  virtual int quadrature_points() const = 0;
  virtual double evaluated(System& s, const State& now, const State& next, int i, State& at) = 0;
};

}  // namespace trammel
