// Self-locking: load and friction of a sliding joint increase each other without bound.
#pragma once

#include "system/assembled_system.hpp"

namespace trammel::model {

class LocksItself : public NotSolvable {
 public:
  using NotSolvable::NotSolvable;
};

}  // namespace trammel::model
