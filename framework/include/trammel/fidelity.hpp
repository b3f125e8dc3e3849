// Ability of a body, force or contact: parameters that trade accuracy of the model for time, such as a number of modes.
// `trammel trade` runs their ladders; the others are properties of the thing that is modelled.
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
