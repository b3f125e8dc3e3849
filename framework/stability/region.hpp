// The region of z = h lambda in which a method is stable, and the region of Baumgarte's weights, by their boundaries
// along rays from the origin.
//
// A ray at the angle phi from the negative real axis holds the oscillators of damping ratio zeta = cos(phi):
// |z| = Omega. Baumgarte's equation g'' + 2 delta g' + epsilon^2 g = 0 of a row is the same oscillator with
// Omega = epsilon h and zeta = delta/epsilon, which a method integrates as it integrates the motion.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include <trammel/linear_theory.hpp>
#include <trammel/testing/measurements.hpp>

namespace trammel::stability {

// Where the radius first exceeds 1; `most` if it does not up to there.
struct BoundaryPoint {
  double zeta = 0;
  double measured = 0;             // Omega
  std::optional<double> theory{};  // Omega
  bool open = false;               // stable up to `most`
};

constexpr double growth = 1e-6;  // of the radius beyond 1: larger than the error of measured roots

// The smallest Omega up to `most` with radius(Omega) > 1 + growth, by a scan in steps of 0.05 and bisection.
double boundary(const std::function<double(double Omega)>& radius, double most);

// On x'' + 2 zeta omega x' + omega^2 x = 0; a rejected step counts as unstable.
std::vector<BoundaryPoint> motion_region(const Maker& method, const LinearTheory* theory, double most, int rays);

// Makes the method with Baumgarte's weights delta h, epsilon h for steps h = 1.
using RowMaker = std::function<Maker(double delta, double epsilon)>;
// On the row q = 0 of a free particle that starts off it.
std::vector<BoundaryPoint> row_region(const RowMaker& method, const LinearTheory* theory, double most, int rays);

}  // namespace trammel::stability
