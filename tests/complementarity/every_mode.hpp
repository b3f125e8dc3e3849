// All modes of planar contacts, one after the other: open, or closed and sticking, or sliding to and fro. Of each mode
// the forces are >= 0 along the edges of its cone and the accelerations that it allows are >= 0: linear equations with
// a solution or none
// (feasible_point.hpp). Costs 4^n of them. Complete and simple, and independent of the code that it judges.
#pragma once

#include "problem.hpp"

namespace trammel::complementarity {

// Whether some mode has forces that obey the law; fills F with the first found.
bool exists_in_some_mode(const Problem& problem, Vec& F);

}  // namespace trammel::complementarity
