// Ability of joints and forces that hold, measure or turn the axes of their markers. A point in natural coordinates has a place and
// no axes (LinearMarkers in linear_rows.hpp): on it such a row would be empty and such a moment without effect, which the framework
// refuses in its place.
#pragma once

namespace trammel {

class NeedsOrientation {
 public:
  virtual ~NeedsOrientation();
  // Directions fixed in this marker (0: A, 1: B, ...), its angle or its angular velocity count, or a moment acts on it. Asked after
  // `prepare`.
  virtual bool needs_orientation(int marker) const = 0;
};

}  // namespace trammel
