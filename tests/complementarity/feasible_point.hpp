// Whether B x = d has a solution x >= 0: the first phase of the simplex method, in the end with Bland's rule, which
// cannot cycle, in extended precision. Slow, and shares nothing with the code that it judges.
#pragma once

#include <trammel/types.hpp>

namespace trammel::complementarity {

// Fills x with the point found; returns how far it is from B x = d, the sum of |B x - d|. Rows and d should be of the
// order of 1.
double feasible_point(const Mat& B, const Vec& d, Vec& x);

}  // namespace trammel::complementarity
