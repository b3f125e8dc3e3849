// Contributions of bodies to the fronts' rows and masses: for each source (front_layout.hpp) a column of G^T or M,
// copied from the bodies, which are scattered in memory.
//
// Contributions that never change are copied once, and stored once if they are equal: in a truss all pins and masses
// are of a few kinds.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "linear/fronts/front_layout.hpp"

namespace trammel::numerics {

class FrontContributions {
 public:
  using Source = FrontLayout::Source;
  // Allocates places for all sources of a layout, and copies the present constant rows.
  void build(const FrontLayout& layout, const std::vector<BodyBlock>& bodies);
  // Copies the present constant masses if `build` was called since the last time.
  void place_masses(const FrontLayout& layout, const std::vector<BodyBlock>& bodies);
  // The numbers of the layout's i-th source.
  const double* of(std::size_t i) const { return numbers_.data() + places_[i]; }
  // The same; a source that may change is first copied from the body.
  const double* update(std::size_t i, const Source& source, const std::vector<BodyBlock>& bodies);
  // Prefetches the changing numbers of a front.
  void prefetch(std::size_t front) const;

 private:
  using Known =
      std::unordered_map<std::string, int>;  // places by their bytes, which distinguish 0 from -0 and allow NaN
  int place(const double* numbers, std::size_t count, Known& known);

  std::vector<int> places_;          // of sources, in numbers_
  std::vector<std::size_t> fronts_;  // index of each front's first source, and the end
  std::vector<double> numbers_;      // changing ones, front by front; then constant ones
  bool masses_placed_ = false;
};

}  // namespace trammel::numerics
