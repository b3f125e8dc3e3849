// A slip in space without a direction: it is slower than `least_slip` (system/point/slip.hpp).
//
// One that stays so for many times the time in which its acceleration would end this is held: friction whose direction
// is not resolved there acts as a stiff damper that other sticking contacts balance. It has stopped, although it
// crosses no zero.
#pragma once

#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

struct UndirectedSlip {
  double lasted = 0;     // [s]
  double pushed = 0;     // [m/s^2] the largest acceleration in that time
  double patience = 10;  // as many times longer than that acceleration needs it may last
  bool stalled = false;  // the last event was that it has lasted longer

  void ends() { lasted = pushed = 0; }
  // `acceleration`: of the slip at the end of a step of length h.
  void lasts(double h, double acceleration);
  bool would_stall(double h, double acceleration, double least_slip) const;

  // Of a sliding contact, after a step of length h to `next`, the system's point.
  void measure(model::AssembledSystem& system, int contact, double h, const State& next);
  bool stalls(model::AssembledSystem& system, int contact, double h, const State& next) const;
};

}  // namespace trammel::simulate
