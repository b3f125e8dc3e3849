// Which laws of friction go with which contact law.
#pragma once

#include <trammel/component.hpp>

namespace trammel::model {

// Why the two do not go together in a contact, for a message; null: they do. The contact law is a Restitution or a
// ContactForce, the friction law a SetValuedFriction or a SmoothFriction.
const char* why_apart(const Component& contact_law, const Component& friction_law);

}  // namespace trammel::model
