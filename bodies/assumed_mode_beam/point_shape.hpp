// The shape functions and the foreshortening of the beam at one point x:
//
//     H_ij(x) = int_0^x Phi_y,i' Phi_y,j' dxi
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "modes.hpp"

namespace trammel::beam {

struct Shape {
  double L = 0, hub_radius = 0;
  std::vector<AxialMode> axial;
  std::vector<BendingMode> transverse;
};

struct PointShape {
  double X0 = 0;  // hub radius + x
  Vec phi_x;
  Vec phi_y, slope_y;
  Mat H;  // columns padded (vector_loops.hpp); empty without foreshortening
};

std::vector<PointShape> shapes_at(const Shape& shape, const Vec& x, bool foreshortening);

}  // namespace trammel::beam
