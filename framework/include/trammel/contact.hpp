// Contact laws: what happens in the normal direction when a gap closes. Geometry (gap, normal, their rates) and
// friction are separate; the three combine freely.
//
//     gap [m] > 0 apart; gap_rate = d(gap)/dt [m/s], negative when closing; approach_speed [m/s] > 0 at the last onset
#pragma once

#include <trammel/component.hpp>

namespace trammel {

// The set-valued law: an impulse at onset, then a constraint row while the contact pushes.
class Restitution : public Component {
 public:
  // How a run treats what the law leaves open; the second of each pair reproduces a simplification found in papers.
  enum class Onset { located, next_step };    // the impact at the crossing, or at the end of the step that passed it
  enum class Rebound { free, constrained };   // a separating contact is open, or its row is active at once
  enum class Restart { consistent, carry };   // a, lambda solved anew at a change of mode, or carried over
  enum class Release { when_pulled, never };  // a closed contact opens where it would pull, or holds for good: a latch
  // What e means in an impact (framework/simulate: impact.hpp, poisson_impact.hpp, spring_impact.hpp). Alike for one contact without
  // friction; else newton and poisson may create energy, and energetic never does.
  enum class ImpactLaw {
    newton,     // u+ = -e u-, rates
    poisson,    // N_E = e N_C, impulses of expansion and compression
    energetic,  // W_E = -e^2 W_C, works of the normal force in expansion and compression
  };
  struct Treatment {
    Onset onset = Onset::located;
    Rebound rebound = Rebound::free;
    Restart restart = Restart::consistent;
    // [m/s] Slower impacts have restitution 0, which ends a sequence of bounces. 0: 1e-7 of the scene's speed.
    double capture_speed = 0;
    Release release = Release::when_pulled;
    ImpactLaw impact_law = ImpactLaw::newton;
  };

  virtual double coefficient(double approach_speed) const = 0;  // e in [0, 1]
  virtual Treatment treatment() const = 0;
};

// The compliant law: a force while the gap is negative.
class ContactForce : public Component {
 public:
  virtual double normal(double gap, double gap_rate, double approach_speed) const = 0;  // [N] >= 0; 0 at gap >= 0
  virtual double potential(double gap) const = 0;                                       // [J] stored; 0 at gap >= 0
  // Derivatives of `normal` by gap [N/m] and gap_rate [N s/m].
  struct Slope {
    double by_gap = 0, by_rate = 0;
  };
  virtual Slope slope(double gap, double gap_rate, double approach_speed) const = 0;
};

// Ability of a ContactForce between the points of a surface (SampledSurface) and a sphere, a plane or another surface: the law is
// asked at each of them, and what it answers, times weight, is that point's force. With `normal` a pressure [N/m^2] and the area
// as weight the contact does not depend on how fine the points are.
class ForceBySurfacePoints {
 public:
  virtual ~ForceBySurfacePoints();
  virtual double weight(double area) const = 0;  // [m^2], or [1] where `normal` is the force of a point
  // [m] of the points at most; infinite: the surface chooses (SampledSurface::sample). Without a sphere its radius is infinite.
  virtual double spacing(double sphere_radius) const = 0;
};

}  // namespace trammel
