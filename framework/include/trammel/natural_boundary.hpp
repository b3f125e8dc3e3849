// Ability of a body that deforms as a sum of functions, none of which has a moment at some of its markers: the modes of
// a cantilever at its tip. If a joint or a force applies a moment to such a marker, the deformation converges slowly
// with the number of functions. Runs, statics and modes report this and name the parameter that adds functions with a
// moment there.
#pragma once

#include <optional>
#include <string>

namespace trammel {

class NaturalBoundary {
 public:
  virtual ~NaturalBoundary();
  struct Slow {
    double missing = 0;   // part of the rotation by a constant moment that the functions cannot represent
    std::string setting;  // of the body, true or false: adds the functions, for example "modes.static_transverse"
  };
  // Empty: the functions have a moment at this marker, or the body does not bend at all.
  virtual std::optional<Slow> under_moment(int marker) const = 0;
};

}  // namespace trammel
