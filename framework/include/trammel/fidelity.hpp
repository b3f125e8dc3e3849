// Ability of a component: parameters that trade accuracy for time. `trammel trade` varies them; the others are
// properties of the thing that is modelled.
//
// Of a body, force or contact they are the model's, such as a number of modes. Of an integrator without ErrorEstimate
// that controls its error itself, they are its tolerances (Costs::more_if_smaller), all set to the tolerance that is
// wanted.
#pragma once

#include <string>
#include <vector>

namespace trammel {

struct FidelityParameter {
  enum class Costs { more_if_larger, more_if_smaller };
  std::string name;  // as declared: "modes.transverse"
  Costs costs = Costs::more_if_larger;
  std::vector<std::string> choices = {};  // of a choice, from the cheapest to the most faithful
};

class HasFidelity {
 public:
  virtual ~HasFidelity();
  virtual std::vector<FidelityParameter> fidelity() const = 0;
};

}  // namespace trammel
