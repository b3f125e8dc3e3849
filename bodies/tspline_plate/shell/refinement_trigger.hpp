// Which elements a refinement splits: those where the mesh is too coarse for the motion, or those near a place.
//
//     energy_density   (1/A) int (h/2 eps^T C^ eps + h^3/24 kappa^T C^ kappa) dA over a Bezier cell [J/m^2]
//     curvature_jump   the largest |T kappa(a) - T kappa(b)| between quadrature points of a cell [1/m]
//     contact_pressure the largest pressure of contacts on a point of the cell [Pa], passed by the framework
//
// T kappa are the changes of curvature in the local Cartesian frame, with twice the twist. An element's indicator is
// the largest of its cells'. An element's size gives its level, the number of halvings from the element of the first
// mesh that contains it, in the direction that was halved more often.
#pragma once

#include "tspline_plate/shell/cell_forces.hpp"

namespace trammel::plate {

enum class Indicator { none, energy_density, curvature_jump, contact_pressure };
// An indicator that depends on the plate's shape alone: energy_density, curvature_jump.
double indicate(Indicator indicator, const Cell& cell, const CellVectors& u);

// The elements of a mesh that may still be split, and the cells they consist of.
class Splittable {
 public:
  Splittable() = default;
  // `first`: elements of the first mesh, which may be halved up to `levels` times.
  Splittable(const Multipatch& basis, const std::vector<Box<double>>& first, int levels);

  const std::vector<Box<double>>& elements() const { return elements_; }
  int element_of(int cell) const { return element_of_[std::size_t(cell)]; }  // -1: it may not be split

 private:
  std::vector<Box<double>> elements_;
  std::vector<int> element_of_;
};

}  // namespace trammel::plate
