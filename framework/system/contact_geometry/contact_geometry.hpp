// What the two sides of a contact are to each other at a point of the system: one interface, one file per pairing.
//
//     g_0    [m] gap, positive apart              g_1, g_2   [m] coordinates of A along tangents that are fixed in B
//     rate   = sum_k H_k V_k + g_t                acceleration = sum_k H_k A_k - gamma        V, A: of the markers, A
//     first
//     Q      = sum_k J_k^T H_k^T F                F [N]: forces along the rows
//
// Laws, modes and multipliers are not known here. A contact that acts at many points is a SurfaceContact as well.
#pragma once

#include <memory>
#include <vector>

#include "model/call_site.hpp"
#include "system/markers/marker_motions.hpp"

namespace trammel::model {

class ContactGeometry {
 public:
  // Where the system is; `number` differs from point to point.
  struct Point {
    double t;
    const Vec &q, &v;
    long long number;
  };
  virtual ~ContactGeometry() = default;

  virtual std::vector<int> slots() const = 0;  // of its markers, A first
  virtual CallSite call() const = 0;           // whom to name when the rows fail
  // Row 0, and the tangents' where there are more. `rows` comes in with two markers and all zero.
  virtual void rows(const Point& point, Rows& rows) = 0;
  // S += c dQ/dq at constant F; `rows` are those of the point.
  virtual void add_reaction_tangent(const Point& point, const Rows& rows, const Eigen::Vector3d& F, double c,
                                    Matrix& S) = 0;

  virtual int tangents() const = 0;  // as many as the space has; 1 for a joint
  // The coordinates less those of `anchor`, without what has rolled; in the plane the second is 0.
  virtual Eigen::Vector2d coordinates_from(const Eigen::Vector2d& anchor, const Rows& rows) const;
  // Slip x along the tangents as a vector: one number in the plane and of a joint, else in world axes.
  virtual Vec3 along_tangents(const Eigen::Vector2d& x, const Motion& /*B*/) const { return x.head(1); }
  // A round body in space: its slip is no rate of a coordinate. The part of its spin is counted by `turn`, A's rotation
  // as B sees it since the anchor was taken.
  virtual bool rolls() const { return false; }
  virtual Eigen::Vector2d rolled(const Eigen::Matrix3d& /*turn*/) const { return Eigen::Vector2d::Zero(); }
};

// The pairing of a contact.
std::unique_ptr<ContactGeometry> make_contact_geometry(const Model& model, const ContactEntry& entry,
                                                       MarkerMotions& chain);

// The pairings.
std::unique_ptr<ContactGeometry> marker_on_plane(const Model& model, const ContactEntry& entry, MarkerMotions& chain);
std::unique_ptr<ContactGeometry> row_limit(const Model& model, const ContactEntry& entry, MarkerMotions& chain);
std::unique_ptr<ContactGeometry> joint_bearing(const Model& model, const ContactEntry& entry, MarkerMotions& chain);
std::unique_ptr<ContactGeometry> surface_on_marker(const Model& model, const ContactEntry& entry, MarkerMotions& chain);
std::unique_ptr<ContactGeometry> surface_on_surface(const Model& model, const ContactEntry& entry,
                                                    MarkerMotions& chain);

}  // namespace trammel::model
