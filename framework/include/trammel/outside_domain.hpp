// Thrown by a component where the state that it is asked at has no answer: a spring whose ends coincide, an arm folded onto
// another, a length that a law of time takes below 0.
//
//     if (length == 0) throw OutsideDomain("its markers coincide, so a spring of rest length > 0 has no direction");
//
// It is the scene's fault, not the component's. At the start it is an error of the scene at the component's line; a trial step
// that meets it is refused, and tried shorter; a run that cannot pass it ends, with its time. The text begins with "its ..." or
// names a thing of the component: "joints.rod: " is put before it. Any other exception blames the plugin. Answers to NaN are NaN.
#pragma once

#include <stdexcept>

namespace trammel {

class OutsideDomain : public std::domain_error {
 public:
  using std::domain_error::domain_error;
  OutsideDomain(const OutsideDomain&) = default;
  ~OutsideDomain() override;
};

}  // namespace trammel
