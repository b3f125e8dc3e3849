// The size of a scene in space and speed, which decides what is round-off at a contact. Sizes only grow, so that what
// counts as touching does not change back. A scene scaled by any factor behaves alike; so does one that is displaced,
// or moves as a whole: place and motion count only by their round-off.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// The sizes, and the thresholds derived from them.
struct Scale {
  static constexpr double round_off = 1e-12;  // of the scene's lengths, speeds and accelerations: sums of many terms

  // [m] The largest gap so far, extent of a body, or distance between the markers of a joint or force.
  double gaps_and_bodies = 0;
  // [m] The largest coordinate of a marker or plane so far: gaps are differences of numbers of this size.
  double place = 0;
  // [m/s] The largest relative speed so far, at contacts, joints, forces and within bodies, and sqrt(gravity length).
  double speed = 0;
  double motion = 0;   // [m/s] the largest of a marker so far: speeds are differences of numbers of this size
  double gravity = 0;  // [m/s^2]

  double length() const { return gaps_and_bodies > 0 ? gaps_and_bodies : place; }
  // [m] Error of the difference of two coordinates.
  double resolution() const { return 4 * std::numeric_limits<double>::epsilon() * place; }
  // [m] Two points no farther apart are one point, computed in two ways; at the origin, from terms of the order of 1 m.
  double one_point() const { return std::max(resolution(), 1e-14); }
  // [m/s] Error of the difference of two velocities, each of which is a sum over a body's coordinates.
  double speed_resolution() const { return 16 * std::numeric_limits<double>::epsilon() * motion; }
  // Nearer than this is touching [m], slower is at rest [m/s], less is no acceleration [m/s^2].
  double touching() const { return round_off * gaps_and_bodies + resolution(); }
  double rest_speed() const { return round_off * speed + speed_resolution(); }
  double no_acceleration() const;
  // [m/s] Impacts are solved to 1e-9 of the rates before them (complementarity/programs/contact_point.hpp).
  double left_by_impacts() const { return 1e-9 * speed + speed_resolution(); }
  // [m/s] Rates up to this may have been left by the steps in rows that they hold.
  double drift() const { return 1e-6 * speed + speed_resolution(); }
  // [m/s] A slower slip in space has no direction (system/point/slip.hpp); slower impacts have no rebound unless the
  // law gives a speed.
  double least_speed() const { return 1e-7 * speed + speed_resolution(); }
  // The accuracy to which positions and velocities are written in a scene.
  double written_length() const { return 1e-9 * length() + resolution(); }
  double written_speed() const { return 1e-9 * speed + speed_resolution(); }

  // A tolerance without `absolute` (0) is relative to the scene: `absolute` becomes `relative` times the length, 1 m at
  // most; for velocities it is larger if round-off shakes bodies at rest by more. If the scene has no length, speed
  // times `every` [s] replaces it.
  Tolerance in_own_unit(const Tolerance& tolerance, double every) const;
  // [m] Error of a position after steps with this tolerance.
  double error_of_position(const Tolerance& tolerance) const;

  void take_length(double length);
  void take_speed(const Vec3& difference);  // a difference of velocities
  void take_fall();                         // takes the speed that gravity gives over the length
  void raise_to(const Scale& other);
};

// The scale of each contact, so that a distant plane does not affect the others: its own gap, place and speed, and the
// extents, distances of joined markers and initial speeds of all bodies in its island, which are connected to its
// bodies or may strike them.
class ContactScale {
 public:
  explicit ContactScale(const model::Model& model);
  void take_all(model::AssembledSystem& system);       // from all markers, at the system's point
  void take_contacts(model::AssembledSystem& system);  // from the markers of contacts

  Scale of(int contact) const;
  std::size_t island(int contact) const { return island_of_contact_[std::size_t(contact)]; }
  const Scale& scene() const { return scene_; }  // the largest of all

  void archive(Archive& a);

 private:
  void take_body(model::AssembledSystem& system, int body);
  void take_distances(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers, double off);
  void take_contact(model::AssembledSystem& system, int contact);
  // Islands: sets of bodies that joints, forces or contacts connect; the ground connects none.
  std::vector<std::size_t> island_of_body_, island_of_contact_;
  std::vector<Scale> islands_;  // without gaps; the last one is for contacts that act on no body
  std::vector<Scale> own_;      // by contact: its gap and speed, and the places and motions of its markers
  Scale scene_;
};

}  // namespace trammel::simulate
