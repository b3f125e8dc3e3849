// Finds the crossing of a continuous function within a bracket, to the resolution asked for.
//
// Without slopes by Algorithm 748 (Alefeld, Potra, Shi 1995, ACM TOMS 21(3)): inverse cubic interpolation guarded by
// bisection, at most twice as many evaluations as bisection, about eight for a smooth function. With slopes by the
// cubic through values and slopes of both ends (Hermite), guarded by bisection: two or three evaluations.
#pragma once

#include <functional>

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

struct ValueAndSlope {
  double f, slope;
};
// A bracket from f > 0 at `low` to f < 0 at `high`.
struct FallingBracket {
  double low, high;
  ValueAndSlope at_low, at_high;
};
// Where the cubic through both ends crosses 0.
double crossing_of_cubic(const FallingBracket& bracket);
// Returns a place at most `resolution` after the crossing, or one so near that 0 >= f >= -round_off.
double crossing(const std::function<ValueAndSlope(double)>& f, FallingBracket bracket, double resolution,
                double round_off);

}  // namespace trammel::numerics
