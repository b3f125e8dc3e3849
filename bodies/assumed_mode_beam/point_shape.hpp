// The shape functions and the foreshortening of the beam at one point x:
//
//     H_ij(x) = int_0^x Phi_y,i' Phi_y,j' dxi
#pragma once

#include <vector>

#include <trammel/types.hpp>

#include "modes.hpp"
#include "static_functions.hpp"

namespace trammel::beam {

// The functions whose sum is the deformation: the modes, followed by the static functions, if there are any.
struct Shape {
  double L = 0, hub_radius = 0;
  std::vector<AxialMode> axial;
  std::vector<BendingMode> transverse;
  std::vector<StaticFunction<AxialMode>> static_axial;
  std::vector<StaticFunction<BendingMode>> static_transverse;

  int axial_count() const { return int(axial.size() + static_axial.size()); }
  int transverse_count() const { return int(transverse.size() + static_transverse.size()); }
  double phi_x(int i, double x) const;
  double phi_y(int i, double x) const;
  double slope_y(int i, double x) const;
};

struct PointShape {
  double X0 = 0;  // hub radius + x
  Vec phi_x;
  Vec phi_y, slope_y;
  Mat H;  // columns padded (vector_loops.hpp); empty without foreshortening
};

std::vector<PointShape> shapes_at(const Shape& shape, const Vec& x, bool foreshortening);

}  // namespace trammel::beam
