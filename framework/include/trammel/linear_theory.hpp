// What theory says about a method on a linear oscillator; `trammel stability` draws it beside measurements.
#pragma once

#include <complex>
#include <vector>

namespace trammel {

// Ability of integrators: the roots of their map on x'' + 2 zeta omega x' + omega^2 x = 0.
class LinearTheory {
 public:
  virtual ~LinearTheory();
  // Eigenvalues of the matrix that takes the history of one step to that of the next, with constant steps h and
  // Omega = omega h > 0, zeta >= 0; called after `prepare`. Its spectral radius is the largest of their moduli. Roots
  // of modulus 0 may be left out.
  virtual std::vector<std::complex<double>> roots(double Omega, double zeta) const = 0;
};

}  // namespace trammel
