// What the rules of contacts read of the scene at every event, and what its laws say of a contact.
#pragma once

#include "run/contact_scale.hpp"
#include "run/settings.hpp"

namespace trammel::simulate {

struct ContactScene {
  model::AssembledSystem& system;
  const ContactScale& scale;
  const StepChoice& steps;   // while contacts are closed
  double chatter_steps = 0;  // as many steps must follow a motion that an impact begins (rule 2)

  const model::ContactEntry& contact(int i) const { return system.model().contacts[std::size_t(i)]; }
  Restitution::Treatment treatment(int contact) const { return this->contact(contact).restitution->treatment(); }
  bool locks(int contact) const { return treatment(contact).release == Restitution::Release::never; }  // a latch
  double capture_speed(int contact) const;
  double stick_speed(int contact) const;
  double least_slip(int contact) const;  // [m/s] a slower one has no direction; 0 in the plane, where no slip turns
};

}  // namespace trammel::simulate
