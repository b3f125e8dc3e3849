// Which rows touch which bodies: what is laid out once, for elimination orders and fronts, lasts as long as this does.
#pragma once

#include <vector>

#include "linear/bodies/body_block.hpp"

namespace trammel::numerics {

class RowPlaces {
 public:
  void take(const std::vector<BodyBlock>& bodies, int nc);
  bool are_of(const std::vector<BodyBlock>& bodies, int nc) const;  // the first nc rows, and all bodies' rows

 private:
  int nc_ = -1;
  std::vector<int> rows_;  // body by body, with a border behind each
};

}  // namespace trammel::numerics
