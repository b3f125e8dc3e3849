// The crossing of a continuous function within a bracket, to the resolution asked for.
//
// Algorithm 748 (Alefeld, Potra, Shi 1995, ACM TOMS 21(3)): inverse cubic interpolation guarded by bisection, at most twice as
// many evaluations as bisection, about eight for a smooth function.
#pragma once

#include <functional>

namespace trammel::numerics {

// f(low) and f(high) have opposite signs, or one of them is zero.
struct RootBracket {
  double low, high;
  double f_low, f_high;
};

// Narrows the bracket until it is no wider than `resolution`.
RootBracket narrow(const std::function<double(double)>& f, RootBracket bracket, double resolution);

}  // namespace trammel::numerics
