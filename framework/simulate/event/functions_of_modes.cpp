#include "simulate/event/functions_of_modes.hpp"

#include <algorithm>

#include "simulate/contact/signed_loads.hpp"

namespace trammel::simulate {
namespace {

using Kind = EventFunction::Kind;
using Friction = model::ContactMode::Friction;

struct FunctionsOfModes {
  model::AssembledSystem& system;
  const ContactScale& scale;
  std::vector<EventFunction> all{};

  void add_contact(int contact) {
    const model::ContactEntry& entry = system.model().contacts[std::size_t(contact)];
    const model::AssembledSystem::Sharing sharing = system.sharing(contact);
    const bool as_one = sharing.shared && !sharing.as_spring;
    if (entry.joint) {
      add_loads(contact);
      if (as_one) add_unload(contact, sharing.group);
      return add_friction(contact, as_one);
    }
    if (!mode(contact).closed) return add_approach(contact);
    if (entry.restitution && entry.restitution->treatment().release == Restitution::Release::never) return;
    if (as_one) add_unload(contact, sharing.group);
    if (entry.force)
      all.push_back({.contact = contact, .kind = Kind::leave, .noise = scale.of(contact).touching()});
    else if (!as_one)
      all.push_back({.contact = contact, .kind = sharing.idle ? Kind::idle : Kind::press, .group = sharing.group});
    add_friction(contact, as_one);
  }
  void add_approach(int contact) {
    const Restitution* law = system.model().contacts[std::size_t(contact)].restitution;
    const bool at_ends = law && law->treatment().onset == Restitution::Onset::next_step;
    all.push_back(
        {.contact = contact, .kind = Kind::approach, .at_ends = at_ends, .noise = scale.of(contact).touching()});
  }
  // One for all that share.
  void add_unload(int contact, int group) {
    const auto of_group = [group](const EventFunction& f) { return f.kind == Kind::unload && f.group == group; };
    if (std::none_of(all.begin(), all.end(), of_group))
      all.push_back({.contact = contact, .kind = Kind::unload, .group = group});
  }
  // `as_one`: the spare load of those that share rows with it covers the force that holds it.
  void add_friction(int contact, bool as_one) {
    const model::ContactEntry& entry = system.model().contacts[std::size_t(contact)];
    if (mode(contact).friction == Friction::slide)
      all.push_back({.contact = contact, .kind = Kind::slide, .noise = scale.of(contact).rest_speed()});
    else if (mode(contact).friction == Friction::stick && !as_one)
      all.push_back({.contact = contact,
                     .kind = Kind::hold,
                     .at_ends = entry.coulomb->decide() == SetValuedFriction::Decide::every_evaluation});
  }
  // Loads of a sticking joint bound the friction that holds it; those of a sliding joint decide its motion.
  void add_loads(int contact) {
    if (mode(contact).friction == Friction::none) return;
    const int count = count_signed_loads(system.model(), contact);
    for (int k = 0; k < count; ++k) all.push_back({.contact = contact, .kind = Kind::load, .bearing = k});
  }
  void add_group(int group) {
    const int contact = system.modes().shared[std::size_t(group)].implied.front().contact;
    all.push_back({.contact = contact, .kind = Kind::follow, .group = group});
    all.push_back({.contact = contact, .kind = Kind::lean, .at_ends = true, .group = group});
    all.push_back({.contact = contact, .kind = Kind::span, .group = group});
  }
  const model::ContactMode& mode(int contact) const { return system.modes().contacts[std::size_t(contact)]; }
};

}  // namespace

std::vector<EventFunction> functions_of_modes(model::AssembledSystem& system, const ContactScale& scale) {
  FunctionsOfModes functions{system, scale};
  for (int i = 0; i < int(system.model().contacts.size()); ++i) functions.add_contact(i);
  for (int group = 0; group < int(system.modes().shared.size()); ++group) functions.add_group(group);
  return functions.all;
}

}  // namespace trammel::simulate
