// Abilities by which rows that are linear in the coordinates are formed once: joints between points of bodies in natural coordinates.
//
//     g = G q + g_0,   g_dot = G v,   gamma = 0        G constant
//
// A joint's rows are so if it has LinearRows and each of its markers is on a body with LinearMarkers or on the ground. The framework
// takes G and g_0 at q = 0, t = 0, and asks neither body nor joint for these rows again until the set of rows changes.
#pragma once

namespace trammel {

// Of a body with flat coordinates: at each of its markers x = x_0 + J q and V = J v with constant J, and the axes never turn.
class LinearMarkers {
 public:
  virtual ~LinearMarkers();
};

// Of a joint: as linear in the places of its markers, while their axes do not turn.
class LinearRows {
 public:
  virtual ~LinearRows();
  virtual bool linear() const = 0;  // asked after `prepare`
};

}  // namespace trammel
