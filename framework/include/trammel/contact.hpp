// Contact laws: the response in the normal direction when a gap closes. Geometry (gap, normal, their rates) and
// friction are separate; the three combine freely.
//
//     gap [m] > 0: open;  gap_rate = d(gap)/dt [m/s] < 0: closing;  approach_speed [m/s] > 0: -gap_rate at last onset
#pragma once

#include <trammel/component.hpp>

namespace trammel {

// The set-valued law: an impulse at onset, then a constraint row while the contact force is compressive.
class Restitution : public Component {
 public:
  // Choices that the law leaves open. In the first three, the second value reproduces a simplification found in papers.
  enum class Onset { located, next_step };    // impact at the crossing, or at the end of the step that passed it
  enum class Rebound { free, constrained };   // after an impact: open if it separates, or its row is active at once
  enum class Restart { consistent, carry };   // at a change of mode: a, lambda solved again, or carried over
  enum class Release { when_pulled, never };  // opens when its force would be tensile, or never (a latch)
  // The meaning of e in an impact (framework/simulate/impact: impact.hpp, poisson_impact.hpp, spring_impact.hpp). The
  // three agree for one contact without friction. Otherwise newton and poisson may create energy; energetic never does.
  enum class ImpactLaw {
    newton,     // u+ = -e u-, rates
    poisson,    // N_E = e N_C, impulses of expansion and compression
    energetic,  // W_E = -e^2 W_C, works of the normal force in expansion and compression
  };
  struct Treatment {
    Onset onset = Onset::located;
    Rebound rebound = Rebound::free;
    Restart restart = Restart::consistent;
    // [m/s] e = 0 for slower impacts, which ends a sequence of bounces. 0: 1e-7 of the scene's speed.
    double capture_speed = 0;
    Release release = Release::when_pulled;
    ImpactLaw impact_law = ImpactLaw::newton;
  };

  virtual double coefficient(double approach_speed) const = 0;  // e in [0, 1]
  virtual Treatment treatment() const = 0;
};

// The compliant law: a force that acts while the gap is negative.
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

// Ability of a ContactForce between the points of a surface (SampledSurface) and a sphere, a plane or another surface.
// The law is evaluated at each point; the force on the point is `normal` times `weight`. If `normal` is a pressure
// [N/m^2] and the weight is the area, the contact does not depend on the density of the points.
class ForceBySurfacePoints {
 public:
  virtual ~ForceBySurfacePoints();
  virtual double weight(double area) const = 0;  // [m^2], or [1] if `normal` is the force on a point
  // Largest distance between the points [m]; infinite: the surface chooses (SampledSurface::sample). The radius is
  // infinite if there is no sphere.
  virtual double spacing(double sphere_radius) const = 0;
};

}  // namespace trammel
