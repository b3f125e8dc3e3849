#include "simulate/contact/resting_contacts.hpp"

#include "run/contact_scale.hpp"

namespace trammel::simulate {

RestingContacts::RestingContacts(model::AssembledSystem& system)
    : system_(system),
      modes_{.contacts = std::vector<model::ContactMode>(system.model().contacts.size()), .shared = {}} {
  system_.hold_still(true);
  system_.set_modes(modes_);
}

RestingContacts::~RestingContacts() {
  system_.hold_still(false);
  system_.set_modes({.contacts = std::vector<model::ContactMode>(modes_.contacts.size()), .shared = {}});
}

void RestingContacts::close_what_may_push() {
  ContactScale scale(system_.model());
  scale.take_all(system_);
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i)
    modes_.contacts[i].closed =
        system_.model().contacts[i].force || system_.gap(int(i)) <= scale.of(int(i)).written_length();
  system_.set_modes(modes_);
}

bool RestingContacts::close_penetrating() {
  bool changed = false;
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i) {
    bool& closed = modes_.contacts[i].closed;
    if (closed || system_.gap(int(i)) >= 0) continue;
    closed = changed = true;
  }
  if (changed) system_.set_modes(modes_);
  return changed;
}

bool RestingContacts::release_pulling(const Vec& lambda) {
  bool changed = false;
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i) {
    if (!modes_.contacts[i].closed || system_.row({int(i), 0}) < 0 || released_ >= 100) continue;
    if (system_.normal_force(int(i), lambda) >= -1e-9 * lambda.lpNorm<Eigen::Infinity>()) continue;
    modes_.contacts[i].closed = false;
    changed = true, ++released_;
  }
  if (changed) system_.set_modes(modes_);
  return changed;
}

void RestingContacts::carry_along() {
  for (std::size_t i = 0; i < modes_.contacts.size(); ++i) {
    const model::ContactEntry& contact = system_.model().contacts[i];
    model::ContactMode& mode = modes_.contacts[i];
    mode.closed = mode.closed && (contact.restitution || contact.joint || system_.gap(int(i)) < 0);
    if (mode.closed && contact.coulomb && contact.coulomb->static_coefficient() > 0)
      mode.friction = model::ContactMode::Friction::stick;
  }
  system_.set_modes(modes_);
}

}  // namespace trammel::simulate
