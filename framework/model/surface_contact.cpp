#include "model/surface_contact.hpp"

namespace trammel::model {

const Wrench& SurfaceContact::on_marker() const {
  static const Wrench none = Wrench::Zero(6);
  return none;
}

std::unique_ptr<SurfaceContact> make_surface_contact(const Model& model, const ContactEntry& entry,
                                                     MarkerChain& chain) {
  return entry.surface->against == SurfaceSide::Against::surface ? surface_on_surface(model, entry, chain)
                                                                 : surface_on_marker(model, entry, chain);
}

}  // namespace trammel::model
