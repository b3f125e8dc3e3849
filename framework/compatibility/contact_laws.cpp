#include "compatibility/contact_laws.hpp"

namespace trammel::compatibility {

ContactLaws::ContactLaws(const Component* normal, const Component* friction)
    : restitution(dynamic_cast<const Restitution*>(normal)),
      force(dynamic_cast<const ContactForce*>(normal)),
      sticking(dynamic_cast<const SetValuedFriction*>(friction)) {}

ContactLaws::ContactLaws(const model::ContactEntry& contact)
    : restitution(contact.restitution), force(contact.force), sticking(contact.coulomb) {}

std::vector<Need> ContactLaws::needs() const {
  std::vector<Need> all;
  const bool by_events = sticking && sticking->decide() == SetValuedFriction::Decide::at_events;
  if (restitution || by_events) all.push_back(Need::rows);
  if (by_events) all.push_back(Need::friction);
  if (sticking && !by_events) all.push_back(Need::jumps);
  if (restitution || force || by_events) all.push_back(Need::events);
  return all;
}

bool ContactLaws::needs_fixed_steps() const {
  return restitution && restitution->treatment().onset == Restitution::Onset::next_step;
}

const char* ContactLaws::why_not_in_statics() const {
  if (sticking)
    return "friction that sticks leaves a range of equilibria that depends on the path, and 'trammel static' finds the "
           "one without friction";
  if (restitution && restitution->treatment().release == Restitution::Release::never)
    return "a contact that locks where it closes depends on the path, and 'trammel static' would open it where it "
           "pulls";
  return nullptr;
}

const char* ContactLaws::why_not_in_modes() const {
  if (sticking && sticking->decide() == SetValuedFriction::Decide::every_evaluation)
    return "friction that is decided at every evaluation has no derivative where it sticks, and the modes would be "
           "those without friction";
  return nullptr;
}

}  // namespace trammel::compatibility
