// A joint that slides, whose load and friction raise each other without bound.
#pragma once

#include "system/assembled_system.hpp"

namespace trammel::model {

class LocksItself : public NotSolvable {
 public:
  using NotSolvable::NotSolvable;
};

}  // namespace trammel::model
