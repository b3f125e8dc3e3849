// Contact of a body's surface: the law is asked at every point of the surface that is reached, by a sphere around a marker or a
// plane of one (surface_on_marker.cpp) or by another surface (surface_on_surface.cpp).
//
// The contact closes and opens with its gap: that of the nearest point of the surface right under a sphere, else that of the
// deepest of the points. Points have no rotation, so the moment of friction about a sheet's mid-surface, half the thickness
// times F_t, is left out.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "system/markers/marker_motions.hpp"
#include "system/contact_geometry/point_pressure.hpp"

namespace trammel::model {

class SurfaceContact {
 public:
  // Where the system is; `number` differs from point to point.
  struct Point {
    double t;
    const Vec &q, &v;
    long long number;
  };
  virtual ~SurfaceContact() = default;

  virtual std::array<int, 2> slots() const = 0;  // of A and B in the chain
  // The one row, all zero before, and the motions in the slots.
  virtual void gap_row(const Point& point, Rows& rows) = 0;
  // Everything below is there.
  virtual void press(const Point& point, double approach_speed) = 0;

  virtual const PressureSums& sums() const = 0;
  virtual void add_force(Vec& f) const = 0;  // on both
  // S += c_k K + c_d D of minus these forces.
  virtual void add_tangent(const Point& point, double c_k, double c_d, Matrix& S) = 0;
  // On the marker of the sphere or plane; nothing where it acts between surfaces.
  struct OnMarker {
    int slot;
    Wrench wrench;
  };
  virtual std::optional<OnMarker> on_marker() const { return {}; }
  // Raises each patch's pressure to the largest of this contact [Pa]; with as many entries as the body has patches.
  virtual void raise_pressure(int body, std::vector<double>& by_patch) const = 0;
  // How far all of the surface lies behind the plane [m]; negative: some of it does not, or there is no plane.
  virtual double all_behind(const Point& /*point*/) { return -1; }
};

std::unique_ptr<SurfaceContact> make_surface_contact(const Model& model, const ContactEntry& entry, MarkerMotions& chain);

// The two kinds.
std::unique_ptr<SurfaceContact> surface_on_marker(const Model& model, const ContactEntry& entry, MarkerMotions& chain);
std::unique_ptr<SurfaceContact> surface_on_surface(const Model& model, const ContactEntry& entry, MarkerMotions& chain);

}  // namespace trammel::model
