// Which friction laws can be combined with which contact law.
#pragma once

#include <trammel/component.hpp>

namespace trammel::model {

// Why the two cannot be combined in a contact, for a message; null: they can. The contact law is a Restitution or a
// ContactForce, the friction law a SetValuedFriction or a SmoothFriction.
const char* why_apart(const Component& contact_law, const Component& friction_law);

}  // namespace trammel::model
