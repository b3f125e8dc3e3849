// What bodies give to the fronts' own rows and masses: of each source (front_layout.hpp) a column of G^T or M, copied
// from the bodies, where they lie apart.
//
// Those known never to change are copied once, and kept once where they are alike. In a truss all pins and masses are a
// few kinds: of a prismatic mast 0.3 of 2.9 kB a unit are left, which a solution reads three times; 10,000 units take a
// tenth less time a step.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "linear/fronts/front_layout.hpp"

namespace trammel::numerics {

class FrontContributions {
 public:
  using Source = FrontLayout::Source;
  // Places for all sources of a layout, and constant rows as they are now.
  void build(const FrontLayout& layout, const std::vector<BodyBlock>& bodies);
  // Constant masses as they are now, where build was called since the last time.
  void place_masses(const FrontLayout& layout, const std::vector<BodyBlock>& bodies);
  // Numbers of the layout's i-th source.
  const double* of(std::size_t i) const { return numbers_.data() + places_[i]; }
  // The same; if it changes, as the bodies have it now.
  const double* update(std::size_t i, const Source& source, const std::vector<BodyBlock>& bodies);
  // Those of a front that change, for reading soon.
  void prefetch(std::size_t front) const;

 private:
  using Known =
      std::unordered_map<std::string, int>;  // places by the bytes there: 0 and -0 stay apart, and NaN is itself
  int place(const double* numbers, std::size_t count, Known& known);

  std::vector<int> places_;          // of sources, in numbers_
  std::vector<std::size_t> fronts_;  // where those of each begin, and the end
  std::vector<double> numbers_;      // those that change, front by front; constant ones
  bool masses_placed_ = false;
};

}  // namespace trammel::numerics
