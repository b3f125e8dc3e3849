// Rule 9 of contact_mode.hpp: latches that touch without a rate lock.
#pragma once

#include <vector>

#include "simulate/contact/contact_changes.hpp"
#include "simulate/contact/contact_scene.hpp"
#include "simulate/results/contact_event.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

// They leave at.touching; their rows hold from here on, so at.before has them. The system is then at `state`, in these
// modes.
void lock_latches(const ContactScene& scene, const State& state, const ContactChanges& changes, ContactsAtEvent& at,
                  std::vector<ContactEvent>& events);

}  // namespace trammel::simulate
