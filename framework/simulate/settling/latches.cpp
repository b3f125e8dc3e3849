#include "simulate/settling/latches.hpp"

namespace trammel::simulate {

void lock_latches(const ContactScene& scene, const State& state, const ContactChanges& changes, ContactsAtEvent& at,
                  std::vector<ContactEvent>& events) {
  model::Modes held = at.before;
  const auto locked = [&](const TouchingContact& c) {
    if (!scene.locks(c.contact) || !(contains(changes.struck, c.contact) || c.impulse > 0) ||
        c.after > scene.scale.of(c.contact).rest_speed())
      return false;
    held.contacts[c.contact].closed = at.modes.contacts[c.contact].closed = true;
    at.modes.contacts[c.contact].approach_speed = -c.before;
    events.push_back({.t = state.t,
                      .kind = ContactEvent::Kind::latch,
                      .contact = c.contact,
                      .impulse = c.impulse,
                      .approach = -c.before,
                      .separation = c.after,
                      .energy_lost = c.energy_lost()});
    return true;
  };
  if (std::erase_if(at.touching, locked) == 0) return;
  at.before = held;
  scene.system.set_modes(held);
  scene.system.move_to(state.t, state.q, state.v);
}

}  // namespace trammel::simulate
