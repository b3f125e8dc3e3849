// Finds the crossing of a continuous function within a bracket, to the resolution asked for.
//
// Without slopes by Algorithm 748 (Alefeld, Potra, Shi 1995, ACM TOMS 21(3)): inverse cubic interpolation guarded by
// bisection, at most twice as many evaluations as bisection, about eight for a smooth function. With slopes by the
// cubic through values and slopes of both ends (Hermite), guarded by bisection: two or three evaluations.
#pragma once

#include <functional>

#include "simulate/event/cubic.hpp"

namespace trammel::numerics {

// f(low) and f(high) have opposite signs, or one of them is zero.
struct RootBracket {
  double low, high;
  double f_low, f_high;
};

struct Interval {
  double low, high;
};
// Narrows the bracket until it is no wider than `resolution`.
Interval narrow(const std::function<double(double)>& f, const RootBracket& bracket, double resolution);

// From f > 0 at the low end of the bracket to f < 0 at the high one. Returns a place at most `resolution` after the
// crossing, or one so near that 0 >= f >= -round_off.
double crossing(const std::function<ValueAndSlope(double)>& f, Cubic bracket, double resolution, double round_off);

}  // namespace trammel::numerics
