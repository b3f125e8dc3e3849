// One cubic B-spline N on five knots of its own, by its blossom.
//
// On a span of its knots N is a cubic; its blossom n(x1, x2, x3) is symmetric, affine in each argument, and n(x, x, x)
// = N(x). One recursion gives everything that a T-spline needs of its functions: values, the Bernstein coefficients
// n(a,a,a), n(a,a,b), n(a,b,b), n(b,b,b) on a cell [a, b], and dual functionals (the blossom at another function's
// inner knots). Ramshaw, Computer Aided Geometric Design 6, 1989.
#pragma once

#include <array>

namespace trammel::plate {

using LocalKnots = std::array<double, 5>;

// The blossom of the piece on the span [knots[span], knots[span + 1]], which must not be empty.
double blossom(const LocalKnots& knots, int span, double x1, double x2, double x3);

// The span of the knots that holds the interval [a, b], or -1: outside, or a knot in between.
int span_of(const LocalKnots& knots, double a, double b);

// Bernstein coefficients on [a, b], which lies within one span; zero outside the support.
std::array<double, 4> bernstein_coefficients(const LocalKnots& knots, double a, double b);

// lambda_j(N): the dual functional of the B-spline on `dual`, applied to the B-spline on `knots`. It is taken on a span
// of `dual` where N is one polynomial, as near to the middle as there is.
double dual_functional(const LocalKnots& dual, const LocalKnots& knots);

}  // namespace trammel::plate
