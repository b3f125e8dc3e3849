// Joints that have come apart: rows violated by more than a tenth of the size of what they connect.
//
// A method that does not end its steps on the rows violates them by its error, and without stabilisation it drifts; the
// user judges that by the norms. But if a rod is a tenth too long, or a hinge open by a tenth of its bodies' length,
// the run no longer simulates the mechanism of the scene. Lengths are compared with the largest extent of the markers
// of the joint's bodies, or with the distance of the joint's markers if that is more; angles with 1 rad.
// At the system's point, where the rows are satisfied; to be called once, and again after each new layout. `otherwise`
// [m] is the size of bodies without extent in joints without a length, which is a length up to `round_off` [m].
#pragma once

#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class OpenJoints {
 public:
  // At the system's point, where the rows hold; once, and again after each new layout. `otherwise` [m] is the size of
  // bodies without extent in joints without a length, that is, of at most `round_off` [m].
  void measure(model::AssembledSystem& system, double otherwise, double round_off);
  // "joints.crank by 0.25 m, joints.axis by 0.3 rad", the worst few; empty: none. The system is at `state`.
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
