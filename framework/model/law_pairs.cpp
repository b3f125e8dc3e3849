#include "model/law_pairs.hpp"

#include <trammel/contact.hpp>
#include <trammel/friction.hpp>

namespace trammel::model {

const char* why_apart(const Component& contact_law, const Component& friction_law) {
  const auto* sticking = dynamic_cast<const SetValuedFriction*>(&friction_law);
  if (!sticking) return nullptr;
  if (dynamic_cast<const ForceBySurfacePoints*>(&contact_law))
    return "on a surface friction is a force at each point: it takes a smooth law such as regularized_coulomb";
  const auto* restitution = dynamic_cast<const Restitution*>(&contact_law);
  if (!restitution) return nullptr;
  if (sticking->decide() == SetValuedFriction::Decide::every_evaluation)
    return "friction that is decided at every evaluation takes the normal force as given: it needs a compliant "
           "contact, such as continuous_force";
  if (restitution->treatment().release == Restitution::Release::never)
    return "a contact that locks has a force of either sign, and friction that sticks would act in its impact only: it "
           "takes a smooth law such as regularized_coulomb";
  return nullptr;
}

}  // namespace trammel::model
