// How far the beam may bend.
//
// In the arc length x of an inextensible axis, u_y' = sin psi with the angle psi of the axis, so that u_x' = cos psi -
// 1, and the curvature is psi'. The beam uses u_x' = -u_y'^2/2 (coupling full; 0 in the others), psi = atan u_y' and
// psi' = u_y''. With the slope s at the tip, the first errors relative to the elastica are:
//
//     full           the displacement: 16/35 s^2 of it under a force across the tip, 11/12 s^2 under a moment;
//                    the angle: 4/3 s^2
//     linear, none   the foreshortening: 2/5 s of the displacement under a force, 1/3 s under a moment
//
// No angle has a sine larger than 1.
//
// A moment M at the tip turns it by M L/(EI). Modes turn it by M sum_i Phi_i'(L)^2/k_i with their stiffnesses k_i:
// about 4/(pi^2 N) of the rotation is missing, since no mode has a moment there.
#include <cmath>

#include "beam.hpp"

namespace trammel::beam {

double AssumedModeBeam::stretched(double, In q) const {
  return N_ > 0 ? (slopes_ * q.segment(i_B_, N_)).lpNorm<Eigen::Infinity>() : 0;
}

TheoryLimit::Bounds AssumedModeBeam::bounds() const {
  constexpr double error = 0.01;
  const bool full = coupling == Coupling::full;
  return {"slope against its undeformed axis", full ? std::sqrt(error * 3 / 4) : error * 5 / 2, 1,
          full ? "several beams joined end to end bend further" : "\"coupling\": \"full\" goes further"};
}

std::optional<NaturalBoundary::Slow> AssumedModeBeam::under_moment(int marker) const {
  if (static_transverse || N_ == 0 || marker_x_(marker) < length) return {};
  const Vec& slope = marker_shapes_[std::size_t(marker)].slope_y;
  const double turn = (slope.array().square() / K2_.array()).sum();
  return Slow{1 - turn * youngs_modulus * second_moment / length, "modes.static_transverse"};
}

}  // namespace trammel::beam
