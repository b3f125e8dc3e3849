// The size of a scene, in space and speed, which tells what happens to a contact from round-off.
//
//     length [m]    the largest coordinate of a marker or plane so far: gaps are differences of numbers of this size
//     speed [m/s]   the largest of a contact's marker so far, and sqrt(|gravity| length)
//
// Both grow only, so that what counts as touching does not change back; a scene scaled by any factor behaves alike.
#pragma once

#include <trammel/archive.hpp>

#include "model/assembled_system.hpp"

namespace trammel::simulate {

class ContactScale {
 public:
  void take_all(model::AssembledSystem& system);       // all markers, at the system's point
  void take_contacts(model::AssembledSystem& system);  // those of contacts

  double length() const { return length_; }
  double speed() const { return speed_; }
  // Nearer than this is touching [m], slower is at rest [m/s], less is no acceleration [m/s^2].
  double touching() const { return 1e-12 * length_; }
  double at_rest() const { return 1e-12 * speed_; }
  // Slower than this may be what the steps leave of the rates of rows that they hold [m/s].
  double drift() const { return 1e-6 * speed_; }
  // Slip in space that has no direction [m/s] (model/slip.hpp).
  double slow() const { return 1e-7 * speed_; }
  double no_acceleration() const { return length_ > 0 ? 1e-12 * speed_ * speed_ / length_ : 0; }
  // The digits to which positions and velocities are written in a scene.
  double written_length() const { return 1e-9 * length_; }
  double written_speed() const { return 1e-9 * speed_; }

  void archive(Archive& a);

 private:
  void take(const Motion& marker);
  double length_ = 0, speed_ = 0;
};

}  // namespace trammel::simulate
