// The geometry of a contact's two sides at a point of the system: one interface, one file per pairing.
//
//     g_0    [m] gap, positive apart              g_1, g_2   [m] coordinates of A along tangents that are fixed in B
//     rate   = sum_k H_k V_k + g_t                acceleration = sum_k H_k A_k - gamma        V, A: of the markers
//     Q      = sum_k J_k^T H_k^T F                F [N]: forces along the rows
//
// Laws, modes and multipliers are unknown here. A contact that acts at many points is also a SurfaceContact.
#pragma once

#include <memory>
#include <vector>

#include "model/call_site.hpp"
#include "system/markers/marker_motions.hpp"

namespace trammel::model {

class ContactGeometry {
 public:
  // The point of the system; `number` differs from point to point.
  struct Point {
    double t;
    const Vec &q, &v;
    long long number;
  };
  virtual ~ContactGeometry() = default;

  virtual std::vector<int> slots() const = 0;  // of its markers, A first
  virtual CallSite call() const = 0;           // the component to name if the rows fail
  // Row 0, and the rows of the tangents if there are any. On entry `rows` has two markers and is zero.
  virtual void rows(const Point& point, Rows& rows) = 0;
  // S += c dQ/dq at constant F; `rows` are those of the point.
  virtual void add_reaction_tangent(const Point& point, const Rows& rows, const Eigen::Vector3d& F, double c,
                                    Matrix& S) = 0;

  virtual int tangents() const = 0;  // 1 in the plane and for a joint, 2 in space
  // The coordinates relative to `anchor`, minus the part that has rolled; in the plane the second is 0.
  virtual Eigen::Vector2d coordinates_from(const Eigen::Vector2d& anchor, const Rows& rows) const;
  // Slip x along the tangents as a vector: one number in the plane and for a joint, in world axes otherwise.
  virtual Vec3 along_tangents(const Eigen::Vector2d& x, const Motion& /*B*/) const { return x.head(1); }
  // True for a round body in space: its slip is not the rate of a coordinate. `rolled` accounts for its spin; `turn` is
  // A's rotation as seen from B since the anchor was set.
  virtual bool rolls() const { return false; }
  virtual Eigen::Vector2d rolled(const Eigen::Matrix3d& /*turn*/) const { return Eigen::Vector2d::Zero(); }
};

// Chooses the pairing of a contact.
std::unique_ptr<ContactGeometry> make_contact_geometry(const Model& model, const ContactEntry& entry,
                                                       MarkerMotions& markers);

// The pairings.
std::unique_ptr<ContactGeometry> marker_on_plane(const Model& model, const ContactEntry& entry, MarkerMotions& markers);
std::unique_ptr<ContactGeometry> row_limit(const Model& model, const ContactEntry& entry, MarkerMotions& markers);
std::unique_ptr<ContactGeometry> joint_bearing(const Model& model, const ContactEntry& entry, MarkerMotions& markers);
std::unique_ptr<ContactGeometry> surface_on_marker(const Model& model, const ContactEntry& entry,
                                                   MarkerMotions& markers);
std::unique_ptr<ContactGeometry> surface_on_surface(const Model& model, const ContactEntry& entry,
                                                    MarkerMotions& markers);

}  // namespace trammel::model
