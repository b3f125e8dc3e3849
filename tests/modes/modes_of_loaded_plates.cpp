// Modes of plates under static loads against the closed forms of beams: a column, and a strip under tension. A strip
// with Poisson's ratio 0 is a beam of bending stiffness E h^3/12 a width; 12 elements of third degree leave less than
// 1e-5 of the first frequency.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/modes_of.hpp"

namespace trammel::test {
namespace {

using std::numbers::pi;

constexpr double E = 1e9, rho = 1000, L = 1;

std::string strip(double h, const std::string& edges, double force_at_the_end, int steps) {
  return fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, 0],
    "bodies": {{"p": {{"type": "tspline_plate",
      "geometry": {{"shape": "rectangle", "along_u": [1, 0, 0], "along_v": [0, 0.1, 0]}},
      "mesh": {{"elements_u": 12, "elements_v": 1}}, "thickness": {}, "density": {}, "youngs_modulus": {}, "poissons_ratio": 0,
      "quadrature": 4, "edges": {}, "edge_force": {{"u1": [{:.17g}, 0, 0]}}, "load_factor": "=t"}}}},
    "static": {{"steps": {}}}, "simulate": {{"until": 1}}}})",
                     h, rho, E, edges, force_at_the_end, steps);
}

Modes modes_at(const std::string& scene, double load, int count = 1) {
  simulate::ModesOptions options;
  options.at = load, options.count = count;
  return modes_of(scene, {{"simulate.until", fmt::format("{:.17g}", load)}}, options);
}

const std::string clamped = R"({"u0": "clamped"})";
double critical_force(double h) {  // [N/m] of a cantilever
  return pi * pi * E * h * h * h / 12 / (4 * L * L);
}

// Of a cantilever under a dead force, with n = P/EI and m = rho h w^2/EI (both by L), the frequency that makes w = A
// cosh + B sinh + C cos + D sin of the roots of r^4 + n r^2 - m = 0 meet w'' = 0 and w''' + n w' = 0 at the end.
double determinant(double n, double m) {
  const double d = std::sqrt(n * n / 4 + m), a = std::sqrt(d - n / 2), b = std::sqrt(d + n / 2);
  // w'' and w''' + n w' of cosh ax - cos bx and sinh ax - (a/b) sin bx; a^2 + n = b^2.
  const double f = a * a * std::cosh(a) + b * b * std::cos(b), g = a * a * std::sinh(a) + a * b * std::sin(b);
  const double df = a * b * b * std::sinh(a) - a * a * b * std::sin(b),
               dg = a * b * b * std::cosh(a) + a * a * a * std::cos(b);
  return f * dg - g * df;
}
double frequency_of_column(double h, double share) {
  const double n = share * pi * pi / 4;
  double low = 1e-12, high = 13;  // m, 12.36 at n = 0
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    ((determinant(n, middle) > 0) == (determinant(n, low) > 0) ? low : high) = middle;
  }
  return std::sqrt(low * E * h * h / 12 / rho);
}

// The load path only finds the equilibrium; the modes there do not depend on how it was reached.
TEST(ModesOfLoadedPlates, DoNotDependOnTheLoadSteps) {
  std::mt19937 random(7);
  for (int i = 0; i < 6; ++i) {
    const double h = std::uniform_real_distribution(0.004, 0.02)(random);
    const double share = std::uniform_real_distribution(-2.0, 0.9)(random);  // tension, and pressure short of buckling
    const double exact = frequency_of_column(h, std::max(0.0, share));
    double first = 0;
    for (const int steps : {1, 3, std::uniform_int_distribution(4, 12)(random)}) {
      const double w = modes_at(strip(h, clamped, -share * critical_force(h), steps), 1).frequency(0);
      if (steps == 1) first = w;
      EXPECT_NEAR(w, first, 1e-7 * first)
          << "h = " << h << ", " << share << " of the critical force, " << steps << " steps";
    }
    // The strip is stretched or pressed by P/Eh, 1e-4 here at most, which its beam is not.
    if (share > 0) {
      EXPECT_NEAR(first, exact, 1e-3 * exact) << share;
    }
  }
}

// w^2 falls to 0 with the load, and beyond the critical one the straight column is unstable.
TEST(ModesOfLoadedPlates, TheColumnBucklesAtEulersForce) {
  const double h = 0.01;
  for (const double share : {0.5, 0.9, 0.99, 0.999}) {
    const Modes modes = modes_at(strip(h, clamped, -critical_force(h), 4), share);
    const double exact = frequency_of_column(h, share);
    EXPECT_EQ(modes.result["unstable"], 0) << share;
    // The pressed column has a critical force that is less by P/Eh = 2e-5 times a small number; near it that moves w^2
    // by so much of its value at rest.
    const double at_rest = frequency_of_column(h, 0);
    EXPECT_NEAR(std::pow(modes.frequency(0), 2), exact * exact, 1e-4 * at_rest * at_rest) << share;
  }
  for (const double share : {1.001, 1.01, 1.2, 2.0})
    EXPECT_EQ(modes_at(strip(h, clamped, -critical_force(h), 4), share, 2).result["unstable"], 1) << share;
}

// Hinged at both ends under tension: w_k^2 = (k pi/L)^2 (T + EI (k pi/L)^2) / rho A.
TEST(ModesOfLoadedPlates, AStripUnderTensionIsAStiffString) {
  for (const double h : {0.001, 0.003})
    for (const double tension : {10.0, 100.0, 400.0})
      for (const int steps : {1, 5}) {
        const Modes modes = modes_at(strip(h, R"({"u0": "hinged", "u1": "yz"})", tension, steps), 1, 1);
        const double EI = E * h * h * h / 12, exact = pi * std::sqrt((tension + EI * pi * pi) / (rho * h));
        // It is longer by the strain: w as sqrt(1/l), and rho h as 1/l of it.
        const double strain = tension / (E * h);
        EXPECT_NEAR(modes.frequency(0), exact, (strain + 1e-5) * exact) << h << " " << tension << " " << steps;
      }
}

}  // namespace
}  // namespace trammel::test
