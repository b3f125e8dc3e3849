// Ability of a body whose equations are valid for small deformations only, such as a beam with small slopes. Runs,
// statics and modes check it: they warn when the theory's error exceeds 1 %, and end when the shape is impossible for
// any body.
#pragma once

#include <string>

#include <trammel/types.hpp>

namespace trammel {

class TheoryLimit {
 public:
  virtual ~TheoryLimit();
  struct Bounds {
    std::string measure;      // the limited quantity, for example "slope of its axis"
    double accurate = 0;      // up to this value the theory's error is below 1 %
    double possible = 0;      // beyond this value no body can have the shape
    std::string alternative;  // what to use instead: a sentence without its full stop
  };
  virtual Bounds bounds() const = 0;                   // constant
  virtual double stretched(double t, In q) const = 0;  // the measure at q, >= 0; called once per step
};

}  // namespace trammel
