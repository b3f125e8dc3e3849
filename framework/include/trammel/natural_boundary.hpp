// Ability of a body that deforms as a sum of functions, none of which has a moment at some of its markers: the modes of
// a cantilever at its tip. Where a joint or a force turns such a marker, the deformation converges slowly with their
// number. Runs, statics and modes say so, and name the parameter that adds functions which have a moment there.
#pragma once

#include <optional>
#include <string>

namespace trammel {

class NaturalBoundary {
 public:
  virtual ~NaturalBoundary();
  struct Slow {
    double missing = 0;   // part of the turn by a constant moment that the functions do not have
    std::string setting;  // of the body, true or false: adds the functions, for example "modes.static_transverse"
  };
  // Nothing: the functions have a moment at this marker, or the body does not bend at all.
  virtual std::optional<Slow> under_moment(int marker) const = 0;
};

}  // namespace trammel
