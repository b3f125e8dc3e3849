// Units of a body's observables, for tables and plots.
#pragma once

#include <string_view>

namespace trammel {

// Ability of a body that is Observed.
class ObservedUnits {
 public:
  virtual ~ObservedUnits();
  virtual std::string_view unit(int observable) const = 0;  // "rad/s"; "1": a number without one
};

}  // namespace trammel
