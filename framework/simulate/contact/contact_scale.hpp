// The size of a scene, in space and speed, which decides what of a contact is round-off.
//
//     length [m]    the largest gap so far, extent of a body, or distance between the markers of a joint or force
//     place [m]     the largest coordinate of a marker or plane so far: gaps are differences of numbers of this size
//     speed [m/s]   the largest of a contact's marker so far, and sqrt(|gravity| length)
//
// All three grow only, so that what counts as touching does not change back. A scene scaled by any factor behaves alike, and so
// does one that is moved: place counts only by its round-off.
#pragma once

#include <algorithm>
#include <limits>

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

class ContactScale {
 public:
  void take_all(model::AssembledSystem& system);       // all markers, at the system's point
  void take_contacts(model::AssembledSystem& system);  // those of contacts

  double length() const { return length_ > 0 ? length_ : place_; }
  double speed() const { return speed_; }
  // What the difference of two coordinates may be off by [m].
  double resolution() const { return 4 * std::numeric_limits<double>::epsilon() * place_; }
  // No more than that apart is one point, computed in two ways; at the origin, by terms of the order of 1 m.
  double one_point() const { return std::max(resolution(), 1e-14); }
  // Nearer than this is touching [m], slower is at rest [m/s], less is no acceleration [m/s^2].
  double touching() const { return 1e-12 * length_ + resolution(); }
  double at_rest() const { return 1e-12 * speed_; }
  // Slower than this may be what the steps leave of the rates of rows that they hold [m/s].
  double drift() const { return 1e-6 * speed_; }
  // Slip in space that has no direction [m/s] (system/slip.hpp); impacts slower than that have no rebound unless the law says so.
  double slow() const { return 1e-7 * speed_; }
  double no_acceleration() const;
  // The digits to which positions and velocities are written in a scene.
  double written_length() const { return 1e-9 * length() + resolution(); }
  double written_speed() const { return 1e-9 * speed_; }

  // A tolerance without `absolute` (0) is meant in the scene's own unit: `absolute` then is `relative` times the length, 1 at most.
  // `every` [s] makes a length of a speed where the scene has none.
  Tolerance in_own_unit(const Tolerance& tolerance, double every) const;
  // What steps under this tolerance leave a position off by [m].
  double error_of_position(const Tolerance& tolerance) const;

  void archive(Archive& a);

 private:
  void take(const Motion& marker);
  void take_length(double length);
  void take_distances(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers, double off);
  void take_gaps(model::AssembledSystem& system);
  double length_ = 0, place_ = 0, speed_ = 0, gravity_ = 0;
};

}  // namespace trammel::simulate
