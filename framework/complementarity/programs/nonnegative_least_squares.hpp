// The least squares problem with x >= 0:     minimise |B x - d|,   x >= 0
//
// by the active set method of Lawson and Hanson (Solving Least Squares Problems, 1974, chapter 23). It ends after
// finitely many steps, whatever the rank of B. The residual is 0 exactly where d lies in the cone of B's columns.
#pragma once

#include <trammel/types.hpp>

namespace trammel::complementarity {

// Fills x; returns |B x - d|.
double nonnegative_least_squares(const Mat& B, const Vec& d, Vec& x);

}  // namespace trammel::complementarity
