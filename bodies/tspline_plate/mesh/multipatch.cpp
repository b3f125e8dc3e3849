#include "tspline_plate/mesh/multipatch.hpp"

#include <algorithm>

namespace trammel::plate {

Multipatch::Multipatch(std::vector<TsplineBasis> patches) : patches_(std::move(patches)) {
  for (const TsplineBasis& basis : patches_) {
    const int before = first_function_.empty() ? 0 : first_function_.back();
    if (first_function_.empty()) first_function_ = {0}, first_cell_ = {0};
    for (BezierCell cell : basis.cells()) {
      for (int& f : cell.functions) f += before;
      cells_.push_back(std::move(cell));
    }
    first_function_.push_back(before + basis.size());
    first_cell_.push_back(int(cells_.size()));
  }
}

std::vector<Box<double>> Multipatch::elements() const {
  std::vector<Box<double>> result;
  for (const TsplineBasis& basis : patches_)
    for (const Box<int>& element : basis.mesh().elements()) result.push_back(basis.mesh().parameters(element));
  return result;
}

int Multipatch::patch_at(double u) const {
  int k = patches() - 1;
  while (k > 0 && u < patch(k).mesh().knots(0).front()) --k;
  return k;
}

int Multipatch::patch_of(int cell) const {
  return int(std::upper_bound(first_cell_.begin(), first_cell_.end(), cell) - first_cell_.begin()) - 1;
}

Box<double> Multipatch::range(int k) const {
  const auto &u = patch(k).mesh().knots(0), &v = patch(k).mesh().knots(1);
  return {{u.front(), v.front()}, {u.back(), v.back()}};
}

int Multipatch::cell_at(double u, double v) const {
  const int k = patch_at(u);
  return first_cell(k) + patch(k).cell_at(u, v);
}

void Multipatch::evaluate(int cell, double u, double v, ShapeValues& out) const {
  const int k = patch_of(cell);
  patch(k).evaluate(cell - first_cell(k), u, v, out);
}

}  // namespace trammel::plate
