// Contact of a body's surface: the law is evaluated at every point of the surface with a negative gap to a sphere
// around a marker or a marker's plane (surface_on_marker.cpp) or to another surface (surface_on_surface.cpp).
//
// The contact opens and closes by its gap: for a sphere that of the nearest point of the surface, otherwise that of the
// deepest point. Points have no rotation, so that the moment of friction about a sheet's mid-surface, half the
// thickness times F_t, is neglected.
#pragma once

#include <optional>
#include <vector>

#include "system/contact_geometry/contact_geometry.hpp"
#include "system/contact_geometry/point_pressure.hpp"
#include "system/markers/marker_motions.hpp"

namespace trammel::model {

// It has one row, that of the gap; `rows` finds the motions in the slots of surfaces.
class SurfaceContact : public ContactGeometry {
 public:
  // Evaluates everything below at the point.
  virtual void press(const Point& point, double approach_speed) = 0;

  virtual const PressureSums& sums() const = 0;
  virtual void add_force(Vec& f) const = 0;  // on both bodies
  // S += c_k K + c_d D, the derivatives of minus these forces.
  virtual void add_tangent(const Point& point, double c_k, double c_d, Matrix& S) = 0;
  // The wrench on the marker of the sphere or plane; zero between surfaces.
  struct OnMarker {
    int slot;
    Wrench wrench;
  };
  virtual std::optional<OnMarker> on_marker() const { return {}; }
  // Raises each patch's pressure to the largest one of this contact [Pa]; one entry per patch of the body.
  virtual void raise_pressure(int body, std::vector<double>& by_patch) const = 0;
  // Distance by which the whole surface lies behind the plane [m]; negative: not the whole surface, or no plane.
  virtual double all_behind(const Point& /*point*/) { return -1; }

  CallSite call() const final { return {&entry_.origin, "normal"}; }
  int tangents() const final { return 2; }  // a surface is in space
  // There are no forces along rows: add_tangent has all derivatives.
  void add_reaction_tangent(const Point&, const Rows&, const Eigen::Vector3d&, double, Matrix&) final {}

 protected:
  explicit SurfaceContact(const ContactEntry& entry) : entry_(entry) {}

  const ContactEntry& entry_;
};

}  // namespace trammel::model
