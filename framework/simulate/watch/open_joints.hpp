// Joints that have come apart: rows that are off by more than a tenth of what they hold together.
//
// A method that does not end its steps on the rows leaves them off by its error, and drifts if nothing stabilises them; that is for its
// user to judge, who sees the norms. But where a rod is a tenth too long, or a hinge open by a tenth of its bodies' length, what runs
// is not the mechanism of the scene. Lengths are compared with the larger of the joint's bodies, as far as their markers reach, or
// with the distance of the joint's markers if that is more; angles with 1 rad.
#pragma once

#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class OpenJoints {
 public:
  // At the system's point, where the rows hold; once, and again where the model was laid out anew. `otherwise` [m] is the size of
  // bodies without extent in joints without a length, which is one of no more than `round_off` [m].
  void measure(model::AssembledSystem& system, double otherwise, double round_off);
  // "joints.crank by 0.25 m, joints.axis by 0.3 rad", the worst few; empty: none. At the state, where the system is.
  std::string description(model::AssembledSystem& system, const State& state) const;

 private:
  struct Joint {
    model::RowGroup rows;
    std::vector<model::MarkerRef> markers;  // none: a body with rows of its own
    double size;                            // [m]
  };
  static double distance(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers);
  std::vector<Joint> joints_;
};

}  // namespace trammel::simulate
