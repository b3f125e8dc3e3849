// A marker, or a ball around it, against a plane of another marker: the rows of point_on_plane.cpp in a system.
#include <Eigen/Geometry>

#include "system/contact_geometry/contact_geometry.hpp"
#include "system/markers/twist_rows.hpp"

namespace trammel::model {

namespace {

class MarkerOnPlane final : public ContactGeometry {
 public:
  MarkerOnPlane(const Model& model, const ContactEntry& entry, MarkerMotions& markers)
      : plane_(entry.geometry),
        origin_(entry.origin),
        markers_(markers),
        tangents_(dimension(model.world.space) - 1),
        A_(markers.slot(entry.A)),
        B_(markers.slot(entry.B)) {}

  std::vector<int> slots() const override { return {A_, B_}; }
  CallSite call() const override { return {&origin_, "normal"}; }

  void rows(const Point& at, Rows& rows) override {
    const Motion& A = markers_.motion(A_, at.t, at.q, at.v);
    contact_rows(plane_, A, markers_.motion(B_, at.t, at.q, at.v), rows.g.size() > 1, rows);
  }

  void add_reaction_tangent(const Point& at, const Rows& rows, const Eigen::Vector3d& F, double c, Matrix& S) override {
    markers_.add_reaction_derivative(A_, at.t, at.q, pressed_by(rows.H_A, F[0], F.tail<2>()), c, S);
    markers_.add_reaction_derivative(B_, at.t, at.q, pressed_by(rows.H_B, F[0], F.tail<2>()), c, S);
  }

  int tangents() const override { return tangents_; }
  Vec3 along_tangents(const Eigen::Vector2d& x, const Motion& B) const override {
    if (tangents_ == 1) return x.head(1);
    return B.R * (plane_.tangents * x);
  }
  bool rolls() const override { return tangents_ == 2 && plane_.radius > 0; }
  // Slip is s . u + (omega_A - omega_B) . (r x s), r from the centre to the plane.
  Eigen::Vector2d rolled(const Eigen::Matrix3d& turn) const override {
    const Eigen::AngleAxisd by(turn);
    const Eigen::Vector3d to_contact = -plane_.radius * plane_.normal;
    Eigen::Vector2d x;
    for (int k = 0; k < 2; ++k)
      x[k] = by.angle() * by.axis().dot(to_contact.cross(Eigen::Vector3d(plane_.tangents.col(k))));
    return x;
  }

 private:
  const PointOnPlane& plane_;
  const plugin::Origin& origin_;
  MarkerMotions& markers_;
  int tangents_, A_, B_;
};

}  // namespace

std::unique_ptr<ContactGeometry> marker_on_plane(const Model& model, const ContactEntry& entry,
                                                 MarkerMotions& markers) {
  return std::make_unique<MarkerOnPlane>(model, entry, markers);
}

}  // namespace trammel::model
