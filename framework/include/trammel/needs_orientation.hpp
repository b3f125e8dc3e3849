// Ability of joints and forces that constrain, measure or turn the axes of their markers. A point in natural
// coordinates has a position but no axes (LinearMarkers in linear_rows.hpp). On such a point the row would be empty and
// the moment would have no effect; the framework refuses such scenes.
#pragma once

namespace trammel {

class NeedsOrientation {
 public:
  virtual ~NeedsOrientation();
  // True if the component uses axes fixed in this marker (0: A, 1: B, ...), its angle or its angular velocity, or
  // applies a moment to it. Called after `prepare`.
  virtual bool needs_orientation(int marker) const = 0;
};

}  // namespace trammel
