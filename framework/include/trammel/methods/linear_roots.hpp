// Roots of known methods on x'' + 2 zeta omega x' + omega^2 x = 0 with Omega = omega h, for their LinearTheory
// (trammel/linear_theory.hpp).
//
// As a first-order system the oscillator has the eigenvalues z = h lambda = Omega (-zeta +- sqrt(zeta^2 - 1)). A linear
// method for first-order systems multiplies each eigenvector by a root of its own polynomial in z.
// Hairer, Norsett, Wanner, Solving ODEs I, II.1 and III.2; Hairer, Wanner, Solving ODEs II, IV.2 and V.1.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include <trammel/methods/alpha_method.hpp>
#include <trammel/methods/runge_kutta.hpp>

namespace trammel {

using Roots = std::vector<std::complex<double>>;

// The two z, in the order of the signs above.
std::array<std::complex<double>, 2> oscillator_eigenvalues(double Omega, double zeta);

// Of Newmark's and the alpha methods: eigenvalues of the map of (q, h v, h^2 a) with the auxiliary accelerations a.
Roots alpha_roots(const AlphaMethod::Weights& weights, double Omega, double zeta);

// R(z) = 1 + z b^T (I - z A)^-1 (1, ..., 1)^T of an explicit method.
std::complex<double> stability_function(const Tableau& tableau, std::complex<double> z);
Roots runge_kutta_roots(const Tableau& tableau, double Omega, double zeta);

// The roots of x^n = sum_i coefficients[i] x^(n - 1 - i).
Roots polynomial_roots(const Eigen::VectorXcd& coefficients);

}  // namespace trammel
