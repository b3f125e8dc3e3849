// Ability of a component: parameters that trade accuracy for time. `trammel trade` varies them; the others are
// properties of the thing that is modelled.
//
// A body, force or contact names parameters of the model, such as a number of modes. An integrator that controls its
// error itself, without ErrorEstimate, names its tolerances (Costs::more_if_smaller): `trammel trade` sets all of them
// to the tolerance that it tries.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trammel {

struct FidelityParameter {
  enum class Costs { more_if_larger, more_if_smaller };
  // As declared: "modes.transverse". 0 means "not given" and is not varied; in a text, "10x4", every number is varied.
  std::string name;
  Costs costs = Costs::more_if_larger;
  std::vector<std::string> choices = {};  // for a parameter with .choice(...): from the cheapest to the most accurate
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
