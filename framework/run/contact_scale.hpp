// The size of a scene, in space and speed, which decides what of a contact is round-off. All grow only, so that what
// counts as touching does not change back. A scene scaled by any factor behaves alike, and so does one that is moved,
// or that moves as a whole: place and motion count only by their round-off.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <trammel/archive.hpp>
#include <trammel/integrator.hpp>

#include "system/assembled_system.hpp"

namespace trammel::simulate {

// What counts where sizes are these.
struct Scale {
  double gaps_and_bodies =
      0;  // [m] the largest gap so far, extent of a body, or distance between the markers of a joint or force
  double place =
      0;  // [m] the largest coordinate of a marker or plane so far: gaps are differences of numbers of this size
  double speed = 0;    // [m/s] the largest of one thing against another so far, at contacts, joints, forces and within
                       // bodies, and sqrt(gravity length)
  double motion = 0;   // [m/s] the largest of a marker so far: speeds are differences of numbers of this size
  double gravity = 0;  // [m/s^2]

  double length() const { return gaps_and_bodies > 0 ? gaps_and_bodies : place; }
  // What the difference of two coordinates may be off by [m].
  double resolution() const { return 4 * std::numeric_limits<double>::epsilon() * place; }
  // No more than that apart is one point, computed in two ways; at the origin, by terms of the order of 1 m.
  double one_point() const { return std::max(resolution(), 1e-14); }
  // What the difference of two velocities may be off by [m/s]: each is a sum over a body's coordinates.
  double speed_resolution() const { return 16 * std::numeric_limits<double>::epsilon() * motion; }
  // Nearer than this is touching [m], slower is at rest [m/s], less is no acceleration [m/s^2].
  double touching() const { return 1e-12 * gaps_and_bodies + resolution(); }
  double at_rest() const { return 1e-12 * speed + speed_resolution(); }
  double no_acceleration() const;
  // Slower than this may be what the steps leave of the rates of rows that they hold [m/s].
  double drift() const { return 1e-6 * speed + speed_resolution(); }
  // Slip in space that has no direction [m/s] (system/point/slip.hpp); impacts slower than that have no rebound unless
  // the law says so.
  double slow() const { return 1e-7 * speed + speed_resolution(); }
  // The digits to which positions and velocities are written in a scene.
  double written_length() const { return 1e-9 * length() + resolution(); }
  double written_speed() const { return 1e-9 * speed + speed_resolution(); }

  // A tolerance without `absolute` (0) is meant in the scene's own unit: `absolute` then is `relative` times the
  // length, 1 at most; that of velocities is larger where round-off shakes bodies at rest by more. `every` [s] makes a
  // length of a speed where the scene has none.
  Tolerance in_own_unit(const Tolerance& tolerance, double every) const;
  // What steps under this tolerance leave a position off by [m].
  double error_of_position(const Tolerance& tolerance) const;

  void take_length(double length);
  void take_speed(const Vec3& difference);  // of velocities
  void take_fall();                         // the speed that gravity gives along the length
  void raise_to(const Scale& other);
};

// Each contact's own scale, so that a plane far off decides nothing for the others: its gap, place and speed, and the
// extents, distances of joined markers and speeds at the start of all bodies of its island, which are tied to its own
// or may strike it.
class ContactScale {
 public:
  explicit ContactScale(const model::Model& model);
  void take_all(model::AssembledSystem& system);       // all markers, at the system's point
  void take_contacts(model::AssembledSystem& system);  // those of contacts

  Scale of(int contact) const;
  const Scale& scene() const { return scene_; }  // the largest of all

  void archive(Archive& a);

 private:
  void take_body(model::AssembledSystem& system, int body);
  void take_distances(model::AssembledSystem& system, const std::vector<model::MarkerRef>& markers, double off);
  void take_contact(model::AssembledSystem& system, int contact);
  // Bodies that joints, forces or contacts connect; the ground connects none.
  std::vector<std::size_t> island_of_body_, island_of_contact_;
  std::vector<Scale> islands_;  // without gaps; the last one is of what acts on no body
  std::vector<Scale> own_;      // by contact: its gap and speed, and the places and motions of its markers
  Scale scene_;
};

}  // namespace trammel::simulate
