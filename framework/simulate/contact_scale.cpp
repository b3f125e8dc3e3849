#include "simulate/contact_scale.hpp"

#include <algorithm>
#include <cmath>

namespace trammel::simulate {

void ContactScale::take(const Motion& marker) {
  length_ = std::max(length_, marker.x.cwiseAbs().maxCoeff());
  speed_ = std::max(speed_, marker.V.head(marker.x.size()).cwiseAbs().maxCoeff());
}

void ContactScale::take_all(model::AssembledSystem& system) {
  const model::Model& model = system.model();
  for (int body = 0; body < int(model.bodies.size()); ++body)
    for (int marker = 0; marker < int(model.bodies[body].body->markers().size()); ++marker)
      take(system.motion({body, marker}));
  for (const model::ContactEntry& contact : model.contacts)
    length_ = std::max(length_, contact.geometry.point.cwiseAbs().maxCoeff());
  speed_ = std::max(speed_, std::sqrt(model.world.gravity.norm() * length_));
}

void ContactScale::take_contacts(model::AssembledSystem& system) {
  for (int i = 0; i < int(system.model().contacts.size()); ++i) take(system.contact_marker(i));
  speed_ = std::max(speed_, std::sqrt(system.model().world.gravity.norm() * length_));
}

void ContactScale::archive(Archive& a) {
  a("scale_length", length_), a("scale_speed", speed_);
}

}  // namespace trammel::simulate
