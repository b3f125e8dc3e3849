// Ability of a component: parameters that trade accuracy for time. `trammel trade` varies them; the others are
// properties of the thing that is modelled.
//
// Of a body, force or contact they are the model's, such as a number of modes. Of an integrator without ErrorEstimate
// that controls its error itself, they are its tolerances (Costs::more_if_smaller), all set to the tolerance that is
// wanted.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trammel {

struct FidelityParameter {
  enum class Costs { more_if_larger, more_if_smaller };
  std::string name;  // as declared: "modes.transverse"; a number that is 0 stands for "not given" and is not varied.
                     // Of a text, such as "10x4", every number in it is varied
  Costs costs = Costs::more_if_larger;
  std::vector<std::string> choices = {};  // of a choice, from the cheapest to the most faithful
};

// Another component of the same kind that models the same thing, such as a rigid contact in place of a stiff one.
struct FidelityAlternative {
  std::string type;                                        // "constraint_method"
  std::vector<std::pair<std::string, double>> parameters;  // in place of the component's own: {"restitution", 0.5}
  bool finer = false;                                      // than the component itself
};

class HasFidelity {
 public:
  virtual ~HasFidelity();
  virtual std::vector<FidelityParameter> fidelity() const = 0;
  virtual std::vector<FidelityAlternative> alternatives() const { return {}; }
};

}  // namespace trammel
