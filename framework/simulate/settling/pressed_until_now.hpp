// Normal forces of contacts until an event. Where contacts come to rest out of sliding, their springs stay pushed by
// them (rule 15 of contact_mode.hpp).
#pragma once

#include "simulate/contact/contact_scene.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

// Sets at.pressed; the system is at the event, in the modes until now. 0 of open contacts and of those without rows,
// unknown of all if nothing has slid or if there are no finite forces.
void find_pressed(const ContactScene& scene, ContactsAtEvent& at);
// An impact pushes springs by what it ends: those of its islands are unknown.
void forget_pressed_by_impact(const ContactScene& scene, ContactsAtEvent& at);

}  // namespace trammel::simulate
