// The lines of events.csv that an event of contacts gives.
#pragma once

#include <vector>

#include "simulate/contact/contact_scene.hpp"
#include "simulate/results/contact_event.hpp"
#include "simulate/verdicts/contacts_at_event.hpp"

namespace trammel::simulate {

// Of contacts that were open, or of all if it was an impact without collision.
void append_impacts(const ContactScene& scene, const ContactsAtEvent& at, double t, bool without_collision,
                    std::vector<ContactEvent>& events);
// Contacts that close, open, or lift although they touched without a rate (`candidates`).
void append_normal_events(const ContactsAtEvent& at, double t, const std::vector<int>& candidates,
                          std::vector<ContactEvent>& events);
// Contacts that begin to stick or to slide. The system has the new modes, and `state` their multipliers.
void append_friction_events(const ContactScene& scene, const ContactsAtEvent& at, const State& state,
                            std::vector<ContactEvent>& events);

}  // namespace trammel::simulate
