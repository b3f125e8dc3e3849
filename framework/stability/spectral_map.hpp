// Roots of a method on x'' + 2 zeta omega x' + omega^2 x = 0 over Omega = omega h: measured from its trajectories
// (testing/measurements.hpp) and, where the method has LinearTheory, as theory gives them.
#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include <trammel/linear_theory.hpp>
#include <trammel/testing/measurements.hpp>

namespace trammel::stability {

// The principal root says how the method treats the motion itself: that nearest to the exact factor exp(z) of a step,
// among those that oscillate if there are any.
struct Oscillation {
  double radius = 0;        // the largest modulus of all roots
  double damping = 0;       // of the principal root: the ratio zeta that an exact oscillator of the same root has
  double period_error = 0;  // relative; > 0: the method's period is longer
};
Oscillation oscillation(const std::vector<std::complex<double>>& roots, double Omega, double zeta);

struct MapPoint {
  double Omega = 0;
  std::optional<Oscillation> measured;  // none: a step was rejected
  std::optional<Oscillation> theory;    // none: the method states none
};
// theory may be null.
std::vector<MapPoint> spectral_map(const Maker& method, const LinearTheory* theory, double zeta,
                                   std::span<const double> Omegas);

// `count` values from `first` to `last`, equally spaced in their logarithms.
std::vector<double> logarithmic(double first, double last, int count);

}  // namespace trammel::stability
