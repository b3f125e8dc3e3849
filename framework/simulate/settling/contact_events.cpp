#include "simulate/settling/contact_events.hpp"

#include "simulate/contact/contact_changes.hpp"

namespace trammel::simulate {

using Friction = model::ContactMode::Friction;
using Kind = ContactEvent::Kind;

void append_impacts(const ContactScene& scene, const ContactsAtEvent& at, double t, bool without_collision,
                    std::vector<ContactEvent>& events) {
  for (const TouchingContact& c : at.touching)
    if (c.impulse > 0 && (!c.was_closed || without_collision))
      events.push_back({.t = t,
                        .contact = c.contact,
                        .impulse = c.impulse,
                        .approach = -c.before,
                        .separation = c.after,
                        .energy_lost = c.energy_lost(),
                        .friction = scene.system.along_tangents(c.contact, c.friction)});
  for (const TouchingContact& c : at.bearings)
    if (!c.friction.isZero(0))
      events.push_back({.t = t,
                        .contact = c.contact,
                        .impulse = c.impulse,
                        .energy_lost = c.energy_lost(),
                        .friction = scene.system.along_tangents(c.contact, c.friction)});
}

void append_normal_events(const ContactsAtEvent& at, double t, const std::vector<int>& candidates,
                          std::vector<ContactEvent>& events) {
  for (const TouchingContact& c : at.touching) {
    const bool closed = at.modes.contacts[c.contact].closed;
    ContactEvent event{.t = t, .contact = c.contact, .approach = -c.before, .separation = c.after};
    if (closed != c.was_closed) {
      event.kind = closed ? Kind::close : Kind::open;
    } else if (!closed && contains(candidates, c.contact) && c.impulse > 0) {
      event.kind = Kind::lift;
    } else {
      continue;
    }
    events.push_back(event);
  }
}

void append_friction_events(const ContactScene& scene, const ContactsAtEvent& at, const State& state,
                            std::vector<ContactEvent>& events) {
  for (int i = 0; i < int(at.modes.contacts.size()); ++i) {
    const model::ContactMode &now = at.modes.contacts[i], &before = at.before.contacts[i];
    if (!now.closed || now.friction == Friction::none) continue;
    const bool sticks = now.friction == Friction::stick;
    const bool same =
        before.closed && now.friction == before.friction && (sticks || now.direction.dot(before.direction) > 0);
    if (same) continue;
    const bool slid = before.closed && before.friction == Friction::slide;
    events.push_back({.t = state.t,
                      .kind = sticks ? Kind::stick
                              : slid ? Kind::reversal
                                     : Kind::slip,
                      .contact = i,
                      .friction = scene.system.along_tangents(i, scene.system.friction_force(i, state.lambda)),
                      .direction = scene.system.along_tangents(i, now.direction)});
  }
}

}  // namespace trammel::simulate
