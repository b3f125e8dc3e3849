#include "simulate/settling/pressed_until_now.hpp"

#include <algorithm>

#include "system/point/locks_itself.hpp"

namespace trammel::simulate {
namespace {

bool slid(const model::ContactMode& mode) {
  return mode.closed && mode.friction == model::ContactMode::Friction::slide;
}

// False if the modes until now have no finite forces at this instant.
bool forces_until_now(model::AssembledSystem& system, Vec& lambda) try {
  Vec a;
  system.accelerate({}, a, lambda);
  return lambda.allFinite();
} catch (const model::LocksItself&) {
  return false;
}

}  // namespace

void find_pressed(const ContactScene& scene, ContactsAtEvent& at) {
  const std::vector<model::ContactMode>& before = at.before.contacts;
  at.pressed.assign(before.size(), std::nullopt);
  Vec lambda;
  if (std::none_of(before.begin(), before.end(), slid) || !forces_until_now(scene.system, lambda)) return;
  for (int i = 0; i < int(before.size()); ++i) {
    const bool has_rows = before[std::size_t(i)].closed && scene.contact(i).restitution;
    at.pressed[std::size_t(i)] = has_rows ? std::max(0.0, scene.system.normal_force(i, lambda)) : 0;
  }
}

void forget_pressed_by_impact(const ContactScene& scene, ContactsAtEvent& at) {
  for (const TouchingContact& c : at.touching) {
    if (!(c.impulse > 0)) continue;
    for (std::size_t i = 0; i < at.pressed.size(); ++i)
      if (scene.scale.island(int(i)) == scene.scale.island(c.contact)) at.pressed[i].reset();
  }
}

}  // namespace trammel::simulate
