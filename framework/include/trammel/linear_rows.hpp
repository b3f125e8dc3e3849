// Abilities that declare constraint rows as linear in the coordinates, so that the framework forms them once: joints
// between points of bodies in natural coordinates.
//
//     g = G q + g_0,   g_dot = G v,   gamma = 0        G constant
//
// A joint's rows are linear if it has LinearRows and each of its markers is on a body with LinearMarkers or on the
// ground. The framework evaluates G and g_0 at q = 0, t = 0 and does not evaluate these rows again until the set of
// rows changes.
#pragma once

namespace trammel {

// Ability of a body with flat coordinates: each marker has x = x_0 + J q and V = J v with constant J, and its axes
// never turn.
class LinearMarkers {
 public:
  virtual ~LinearMarkers();
};

// Ability of a joint whose rows are linear in the positions of its markers as long as their axes do not turn.
class LinearRows {
 public:
  virtual ~LinearRows();
  virtual bool linear() const = 0;  // called after `prepare`
};

}  // namespace trammel
