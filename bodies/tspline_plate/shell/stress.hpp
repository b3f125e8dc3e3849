// Stresses of the plate, second Piola-Kirchhoff, in the local Cartesian frame of the reference.
//
//     sigma(z) = C (eps + z kappa),    von Mises^2 = sxx^2 - sxx syy + syy^2 + 3 sxy^2,    z = -h/2, 0, h/2
#pragma once

#include "tspline_plate/shell/discretisation.hpp"
#include "tspline_plate/shell/surface_point.hpp"

namespace trammel::plate {

struct StressState {
  Eigen::Vector3d bottom, middle, top;  // (xx, yy, xy) [Pa]
};
StressState stress(const Discretisation& mesh, const Section& section, const SurfacePoint& point, In q);
double von_mises(const Eigen::Vector3d& stress);

// The largest von Mises stresses over a grid of points that holds the corners of all cells.
struct LargestStress {
  double bottom = 0, middle = 0, top = 0;
};
LargestStress largest_stress(const Discretisation& mesh, const Section& section, In q);

}  // namespace trammel::plate
