// The needs and limits of the laws of one contact, or of the friction in one joint.
#pragma once

#include <vector>

#include "compatibility/need.hpp"
#include "model/model.hpp"

namespace trammel::compatibility {

struct ContactLaws {
  ContactLaws(const Component* normal, const Component* friction);  // either may be null
  explicit ContactLaws(const model::ContactEntry& contact);

  std::vector<Need> needs() const;
  // Impacts at the end of the step that passed the crossing: an error-controlled step may end far behind it.
  bool needs_fixed_steps() const;
  // Why they cannot; null: they can.
  const char* why_not_in_statics() const;
  const char* why_not_in_modes() const;

  const Restitution* restitution = nullptr;
  const ContactForce* force = nullptr;
  const SetValuedFriction* sticking = nullptr;
};

}  // namespace trammel::compatibility
