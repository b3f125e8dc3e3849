#include "system/contact_geometry/contact_geometry.hpp"

namespace trammel::model {

Eigen::Vector2d ContactGeometry::coordinates_from(const Eigen::Vector2d& anchor, const Rows& rows) const {
  Eigen::Vector2d x = -anchor;
  for (int k = 0; k < tangents(); ++k) x[k] += rows.g(1 + k);
  return x;
}

std::unique_ptr<ContactGeometry> make_contact_geometry(const Model& model, const ContactEntry& entry,
                                                       MarkerMotions& markers) {
  if (entry.joint) return joint_bearing(model, entry, markers);
  if (entry.limit) return row_limit(model, entry, markers);
  if (!entry.surface) return marker_on_plane(model, entry, markers);
  return entry.surface->against == SurfaceSide::Against::surface ? surface_on_surface(model, entry, markers)
                                                                 : surface_on_marker(model, entry, markers);
}

}  // namespace trammel::model
