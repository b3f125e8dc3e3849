// How long a step may be whose ends show what a law of time does within it.
//
// The cubic p through values and slopes of f at both ends of a step of length h (Hermite) departs from f by at most
//
//     |f - p| <= c_m h^m max |f^(m) - k|,   c = 3/4, 1/16, 1/96, 1/384  for m = 1, 2, 3, 4,  k any constant, 0 if m = 4
//
// The step shows f if one of these bounds is a small part of what f varies by in the step. f^(m) is bounded over the
// whole step (Series), so no pulse is overlooked, however short. The same is asked of each derivative of the law that
// enters the equations, and of sine and cosine of a law that is an angle: a base that turns at constant speed moves its
// markers to and fro. Where a law jumps or has a kink no step shows it; steps then become nearly as short as `least`.
//
// Source of the constants: Peano's kernels of cubic Hermite interpolation, integrated over the step.
#pragma once

#include <trammel/time_function.hpp>

namespace trammel::scene {

struct LawOfTime {
  TimeFunction law;       // not constant
  int derivatives = 0;    // highest one that enters the equations
  bool is_angle = false;  // [rad]
};

// [s] The first of h, h/2, h/4, ... that shows the law from t on, or the last one that is not below `least`.
double step_that_shows(const LawOfTime& law, double t, double h, double least);

}  // namespace trammel::scene
