// An ability of integrators whose steps are longer than the swings in them: between its ends a step is not near the cubic
// through v and a there. Whoever looks into such a step (events of contacts, the ledger of energies) asks the integrator, so
// its dense output should cost no evaluation.
#pragma once

#include <trammel/integrator.hpp>

namespace trammel {

class OscillatingSteps : public DenseOutput {
 public:
  ~OscillatingSteps() override;
};

}  // namespace trammel
