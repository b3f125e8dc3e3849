// Contact of a body's surface: the law is asked at every point of the surface that is reached, by a sphere around a marker or a
// plane of one (surface_on_marker.cpp) or by another surface (surface_on_surface.cpp).
//
// The contact closes and opens with its gap: that of the nearest point of the surface right under a sphere, else that of the
// deepest of the points. Points have no rotation, so the moment of friction about a sheet's mid-surface, half the thickness
// times F_t, is left out.
#pragma once

#include <optional>
#include <vector>

#include "system/contact_geometry/contact_geometry.hpp"
#include "system/contact_geometry/point_pressure.hpp"

namespace trammel::model {

// Its one row is that of the gap, and `rows` finds the motions in the slots of surfaces.
class SurfaceContact : public ContactGeometry {
 public:
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

  CallSite call() const final { return {&entry_.origin, "normal"}; }
  int tangents() const final { return 2; }  // a surface is in space
  // It has no forces along rows: add_tangent has all of its derivatives.
  void add_reaction_tangent(const Point&, const Rows&, const Eigen::Vector3d&, double, Matrix&) final {}

 protected:
  explicit SurfaceContact(const ContactEntry& entry) : entry_(entry) {}

  const ContactEntry& entry_;
};

}  // namespace trammel::model
