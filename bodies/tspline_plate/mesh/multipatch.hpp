// The functions of several patches as one set.
//
// Patches lie side by side in the plane of parameters, each in a range of u of its own, so that (u, v) determines the
// patch. Functions, cells and elements are numbered patch by patch.
#pragma once

#include "tspline_plate/mesh/tspline_basis.hpp"

namespace trammel::plate {

class Multipatch {
 public:
  explicit Multipatch(std::vector<TsplineBasis> patches);  // by ascending u

  int patches() const { return int(patches_.size()); }
  const TsplineBasis& patch(int k) const { return patches_[std::size_t(k)]; }
  int first_function(int k) const { return first_function_[std::size_t(k)]; }
  int first_cell(int k) const { return first_cell_[std::size_t(k)]; }

  int size() const { return first_function_.back(); }
  const std::vector<BezierCell>& cells() const { return cells_; }
  std::vector<Box<double>> elements() const;

  int patch_at(double u) const;
  int patch_of(int cell) const;
  Box<double> range(int patch) const;
  int cell_at(double u, double v) const;
  void evaluate(int cell, double u, double v, ShapeValues& out) const;

 private:
  std::vector<TsplineBasis> patches_;
  std::vector<BezierCell> cells_;
  std::vector<int> first_function_, first_cell_;  // and, after the last patch, their numbers
};

}  // namespace trammel::plate
