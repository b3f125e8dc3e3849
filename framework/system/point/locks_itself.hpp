// Self-locking: load and friction of a sliding joint increase each other without bound.
#pragma once

#include "system/point/not_solvable.hpp"

namespace trammel::model {

class LocksItself : public NotSolvable {
 public:
  using NotSolvable::NotSolvable;
};

}  // namespace trammel::model
