// Ability of a body whose equations hold for small deformations only, such as a beam with small slopes. Runs, statics
// and modes ask it: they warn where its theory is less accurate than 1 %, and end where no body could have its shape.
#pragma once

#include <string>

#include <trammel/types.hpp>

namespace trammel {

class TheoryLimit {
 public:
  virtual ~TheoryLimit();
  struct Bounds {
    std::string measure;      // what is limited, "slope of its axis"
    double accurate = 0;      // up to here the theory's error is below 1 %
    double possible = 0;      // beyond, no body has this shape
    std::string alternative;  // what to use in place of it, a sentence without its full stop
  };
  virtual Bounds bounds() const = 0;                   // constant
  virtual double stretched(double t, In q) const = 0;  // that measure at q, >= 0; asked once a step
};

}  // namespace trammel
