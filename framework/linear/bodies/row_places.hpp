// Which rows touch which bodies. Elimination orders and fronts are laid out once and remain valid as long as this
// stays.
#pragma once

#include <vector>

#include "linear/bodies/body_block.hpp"

namespace trammel::numerics {

class RowPlaces {
 public:
  void take(const std::vector<BodyBlock>& bodies, int nc);
  // True if the first nc rows, and all rows of the bodies, are the same as in `take`.
  bool are_of(const std::vector<BodyBlock>& bodies, int nc) const;

 private:
  int nc_ = -1;
  std::vector<int> rows_;  // body by body, each followed by a separator
};

}  // namespace trammel::numerics
