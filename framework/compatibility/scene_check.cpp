#include "compatibility/scene_check.hpp"

#include <fmt/format.h>

#include "compatibility/contact_laws.hpp"

namespace trammel::compatibility {
namespace {

using Why = const char* (ContactLaws::*)() const;

// The place in the scene of the refused law: the friction, or the contact.
const scene::Value& place(const model::ContactEntry& contact, bool of_friction, const scene::Value& root) {
  const scene::Value* value = root.at_path(contact.path() + (of_friction ? ".friction" : ""));
  return value ? *value : root;
}

void check(const model::Model& model, Why why, const scene::Value& root, plugin::Registry& registry,
           scene::Problems& problems) {
  for (const model::ContactEntry& contact : model.contacts) {
    const ContactLaws laws(contact);
    const char* const reason = (laws.*why)();
    if (!reason) continue;
    const bool of_friction = laws.sticking != nullptr;
    const auto allowed = [&](const Component& one) {
      return !(of_friction ? (ContactLaws(nullptr, &one).*why)() : (ContactLaws(&one, nullptr).*why)());
    };
    const Kind kind = of_friction ? Kind::friction : Kind::contact;
    problems.error(
        place(contact, of_friction, root)
            .problem(fmt::format("{}; {} laws that work there: {}", reason, of_friction ? "friction" : "contact",
                                 names_that(registry, kind, allowed))));
  }
}

}  // namespace

void check_statics(const model::Model& model, const scene::Value& root, plugin::Registry& registry,
                   scene::Problems& problems) {
  check(model, &ContactLaws::why_not_in_statics, root, registry, problems);
}

void check_modes(const model::Model& model, const scene::Value& root, plugin::Registry& registry,
                 scene::Problems& problems) {
  check(model, &ContactLaws::why_not_in_modes, root, registry, problems);
}

void check_steps(const model::Model& model, const simulate::Settings& settings, const scene::Value& root,
                 scene::Problems& problems) {
  if (settings.step.fixed && settings.contact_step.fixed) return;
  for (const model::ContactEntry& contact : model.contacts)
    if (ContactLaws(contact).needs_fixed_steps())
      problems.error(place(contact, false, root)
                         .problem("an impact at the end of the step that passed the crossing needs steps of a fixed "
                                  "length: one that follows a tolerance may end far behind it. Give \"step\" and "
                                  "\"contact_step\" a number of the integrator, or take \"onset\": \"located\""));
}

void check_momentum(const Correction& correction, const scene::Value& value, const model::Model& model,
                    plugin::Registry& registry, scene::Problems& problems) {
  const auto* needs = dynamic_cast<const NeedsMomentum*>(&correction);
  if (!needs || !needs->needs_momentum()) return;
  for (const model::BodyEntry& body : model.bodies)
    if (body.nv > 0 && !dynamic_cast<const HasMomentum*>(body.body.get()))
      return problems.error(value.problem(fmt::format(
          "it needs the momentum of every body, and bodies.{} does not give its own; bodies that do: {}", body.name,
          names_that<HasMomentum>(registry, Kind::body, [](const HasMomentum&) { return true; }))));
}

}  // namespace trammel::compatibility
