#include "system/contact_geometry/surface_contact.hpp"

namespace trammel::model {

std::unique_ptr<SurfaceContact> make_surface_contact(const Model& model, const ContactEntry& entry,
                                                     MarkerMotions& chain) {
  return entry.surface->against == SurfaceSide::Against::surface ? surface_on_surface(model, entry, chain)
                                                                 : surface_on_marker(model, entry, chain);
}

}  // namespace trammel::model
