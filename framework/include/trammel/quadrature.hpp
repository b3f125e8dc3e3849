// Gauss-Legendre quadrature on [a, b]: exact for polynomials of degree 2n - 1.
#pragma once

#include <trammel/types.hpp>

namespace trammel {

struct Quadrature {
  Vec x, weight;  // (n), x ascending
};

Quadrature gauss_legendre(int n, double a, double b);

}  // namespace trammel
