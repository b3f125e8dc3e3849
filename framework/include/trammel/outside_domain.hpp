// Exception of a component that is not defined at the given state: a spring whose ends coincide, an arm folded onto
// another, a length that a law of time makes negative.
//
//     if (length == 0) throw OutsideDomain("its markers coincide, so a spring of rest length > 0 has no direction");
//
// It reports an error of the scene, not of the component. At the start the message names the component's line in the
// scene. During a run the trial step is rejected and repeated with a smaller h; if no smaller step helps, the run ends
// and the message states the time. The text begins with "its ..." or names a part of the component, because the
// framework puts "joints.rod: " before it. Any other exception is reported as an error of the plugin. For NaN as input
// return NaN.
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
