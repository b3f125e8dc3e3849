// Static functions, which complete the modes of a cantilever: the shapes of a beam that is loaded at its tip.
//
// All modes have no moment, no shear force and no normal force at x = L. Where a joint holds the tip or a load acts
// there, their sum converges slowly to the true shape: with N modes the error of a frequency falls as 1/N under a
// moment or a normal force, as 1/N^3 under a shear force. Each of three polynomials has one of these:
//
//     x^2  (moment),   3 L x^2 - x^3  (shear force),   x  (normal force),
//
// each minus its projection on the modes, s - sum_i c_i Phi_i, which leaves the span unchanged and makes it orthogonal
// to them in the mass. Modes are eigenfunctions, so it is orthogonal to them in the stiffness, too:
//
//     int s'' Phi_i'' dx = b_i^4 int s Phi_i dx        (the boundary terms vanish: Phi_i'' = Phi_i''' = 0 at L)
//
// The two transverse ones are combined so that they are orthogonal to one another in both. Hence M and K of the
// undeformed beam stay diagonal, and all other code treats these functions as further modes. The remaining coefficients
// of the modes are smaller by b^-4 (axial: l^-2), and the errors fall as 1/N^9 under a moment, 1/N^11 under a shear
// force, 1/N^5 under a normal force.
#pragma once

#include <array>
#include <vector>

#include "modes.hpp"

namespace trammel::beam {

inline constexpr int most_static = 2;  // of each kind

// s(x) = p_1 x + p_2 x^2 + p_3 x^3 - sum_i c_i Phi_i(x)
template <class ModeType>
struct StaticFunction {
  std::array<double, 3> p{};
  std::vector<ModeType> modes;
  std::vector<double> c;
  double stiffness = 0;  // int s''^2 dx of bending, int s'^2 dx of stretching

  double value(double x) const;
  double slope(double x) const;
};

// Scaled as the modes are: their squares integrate to L, and to L/2.
std::vector<StaticFunction<BendingMode>> static_bending(double L, const std::vector<BendingMode>& modes);
StaticFunction<AxialMode> static_stretching(double L, const std::vector<AxialMode>& modes);

}  // namespace trammel::beam
