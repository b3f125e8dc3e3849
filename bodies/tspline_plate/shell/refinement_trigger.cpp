#include "tspline_plate/shell/refinement_trigger.hpp"

#include <algorithm>
#include <cmath>

#include "tspline_plate/shell/simd_loops.hpp"

namespace trammel::plate {

namespace {

double energy_density(const Cell& cell, const CellVectors& u) {
  CellEnergy energy;
  add_elastic(cell, u, nullptr, 0, nullptr, &energy);
  double area = 0;
  for (double dA : cell.weight) area += dA;
  return (energy.membrane + energy.bending) / area;
}

double curvature_jump(const Cell& cell, const CellVectors& u) {
  std::vector<Vector3> curvature;
  DeformedPoint at;
  Vectors5 d;
  for (std::size_t p = 0; p < cell.points.size(); ++p) {
    interpolate(cell.padded, &cell.shape[p * 5 * std::size_t(cell.padded)], u, d.data());
    deform(cell.points[p], d, at);
    curvature.push_back(cell.points[p].T * at.kappa);
  }
  double jump = 0;
  for (std::size_t a = 0; a < curvature.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) jump = std::max(jump, (curvature[a] - curvature[b]).norm());
  return jump;
}

bool holds(const Box<double>& box, const Eigen::Vector2d& at) {
  return box.low[0] <= at.x() && at.x() <= box.high[0] && box.low[1] <= at.y() && at.y() <= box.high[1];
}

Eigen::Vector2d middle(const Box<double>& box) {
  return {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
}

const Box<double>* find(const std::vector<Box<double>>& boxes, const Eigen::Vector2d& at) {
  const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const Box<double>& box) { return holds(box, at); });
  return found == boxes.end() ? nullptr : &*found;
}

// Rounded, because a split may follow a neighbour's line that is a little off the middle.
int level(const Box<double>& box, const Box<double>& first) {
  int most = 0;
  for (std::size_t d : {0, 1})
    most = std::max(most, int(std::lround(std::log2((first.high[d] - first.low[d]) / (box.high[d] - box.low[d])))));
  return most;
}

}  // namespace

double indicate(Indicator indicator, const Cell& cell, const CellVectors& u) {
  switch (indicator) {
    case Indicator::energy_density:
      return energy_density(cell, u);
    case Indicator::curvature_jump:
      return curvature_jump(cell, u);
    default:
      return 0;
  }
}

Splittable::Splittable(const Multipatch& basis, const std::vector<Box<double>>& first, int levels) {
  for (const Box<double>& element : basis.elements()) {
    const Box<double>* from = find(first, middle(element));
    if (from && level(element, *from) < levels) elements_.push_back(element);
  }
  for (const BezierCell& cell : basis.cells()) {
    const Box<double>* element = find(elements_, middle(cell.parameters));
    element_of_.push_back(element ? int(element - elements_.data()) : -1);
  }
}

}  // namespace trammel::plate
