#include "compatibility/matrix.hpp"

#include <algorithm>
#include <tuple>

#include <trammel/fields.hpp>
#include <trammel/theory_limit.hpp>

#include "compatibility/contact_laws.hpp"
#include "model/law_pairs.hpp"
#include "plugin/describe.hpp"

namespace trammel::compatibility {
namespace {

template <class T>
bool has(const Component& component) {
  return dynamic_cast<const T*>(&component) != nullptr;
}

std::vector<const plugin::Entry*> of_kind(Kind kind, plugin::Registry& registry) {
  std::vector<const plugin::Entry*> found;
  for (const plugin::Entry* entry : registry.all())
    if (entry->declaration.kind == kind) found.push_back(entry);
  return found;
}

// Forms of all components of a kind; of each component those that differ in `property`.
template <class Property>
std::vector<Form> forms_of(Kind kind, plugin::Registry& registry, Property property) {
  std::vector<Form> all;
  for (const plugin::Entry* entry : of_kind(kind, registry)) {
    const std::vector<Form> some = that_differ(forms(*entry), property);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<Need> taken(const Component& component) {
  std::vector<Need> all;
  for (const Need need : every_need)
    if (takes(dynamic_cast<const Integrator&>(component), need)) all.push_back(need);
  return all;
}

std::vector<Correction::Level> levels(const Component& component) {
  using Level = Correction::Level;
  std::vector<Level> all;
  for (const Level level : {Level::position, Level::velocity, Level::energy})
    if (dynamic_cast<const Correction&>(component).corrects(level)) all.push_back(level);
  return all;
}

bool needs_momentum(const Component& component) {
  const auto* needs = dynamic_cast<const NeedsMomentum*>(&component);
  return needs && needs->needs_momentum();
}

std::string text_or_empty(const char* text) {
  return text ? text : "";
}

LawPair pair(const std::optional<Form>& contact, const std::optional<Form>& friction) {
  const Component* const normal = contact ? contact->component.get() : nullptr;
  const Component* const tangential = friction ? friction->component.get() : nullptr;
  const ContactLaws laws(normal, tangential);
  LawPair one{contact,
              friction,
              "",
              laws.needs(),
              laws.needs_fixed_steps(),
              text_or_empty(laws.why_not_in_statics()),
              text_or_empty(laws.why_not_in_modes())};
  if (normal && tangential) one.why_not = text_or_empty(model::why_apart(*normal, *tangential));
  // The friction of a joint follows from the joint's reaction (joint_friction_input.cpp).
  if (!normal && laws.sticking && laws.sticking->decide() == SetValuedFriction::Decide::every_evaluation)
    one.why_not =
        "friction that is decided at every evaluation takes the normal force as given; that of a joint's "
        "bearing follows from its reaction";
  return one;
}

std::vector<LawPair> all_pairs(plugin::Registry& registry) {
  const auto of_contact = [](const Component& one) {
    const ContactLaws laws(&one, nullptr);
    return std::tuple(laws.needs(), laws.needs_fixed_steps(), laws.why_not_in_statics() != nullptr,
                      has<ForceBySurfacePoints>(one));
  };
  const auto of_friction = [](const Component& one) {
    const ContactLaws laws(nullptr, &one);
    return std::tuple(laws.needs(), laws.why_not_in_modes() != nullptr);
  };
  std::vector<std::optional<Form>> contacts, frictions = {std::nullopt};
  for (Form& form : forms_of(Kind::contact, registry, of_contact)) contacts.emplace_back(std::move(form));
  for (Form& form : forms_of(Kind::friction, registry, of_friction)) frictions.emplace_back(std::move(form));
  contacts.emplace_back(std::nullopt);
  std::vector<LawPair> all;
  for (const auto& contact : contacts)
    for (const auto& friction : frictions)
      if (contact || friction) all.push_back(pair(contact, friction));
  return all;
}

// A value for a parameter that has none: ones.
ParameterValue plausible(const Parameter& parameter) {
  switch (parameter.type) {
    case Parameter::Type::number:
      return 1.0;
    case Parameter::Type::numbers:
      return std::vector<double>{1, 1, 1};
    case Parameter::Type::vector:
      return Vec3(Vec3::Ones(3));
    default:
      return {};
  }
}

// The component in a spatial scene. Parameters that `prepare` asks for by name are given; null if that does not help.
std::unique_ptr<Component> prepared_in_space(const plugin::Entry& entry) {
  const World world{.space = Space::spatial, .gravity = Vec3::Zero(3)};
  std::vector<std::pair<const Parameter*, ParameterValue>> given;
  const auto& parameters = entry.declaration.parameters;
  while (given.size() <= parameters.size()) {
    std::unique_ptr<Component> component = plugin::new_component(entry);
    for (const auto& [parameter, value] : given) parameter->set(*component, value);
    try {
      component->prepare(world);
      return component;
    } catch (const ParameterError& e) {
      const auto asked = std::find_if(parameters.begin(), parameters.end(),
                                      [&e](const Parameter& one) { return one.name == e.parameter(); });
      if (asked == parameters.end() || plausible(*asked).index() == 0) return nullptr;
      given.emplace_back(&*asked, plausible(*asked));
    }
  }
  return nullptr;
}

bool turns_in_space(const plugin::Entry& entry) {
  const std::unique_ptr<Component> body = prepared_in_space(entry);
  if (!body) return false;
  const Coordinates coordinates = dynamic_cast<const Body&>(*body).coordinates();
  return std::any_of(coordinates.parts().begin(), coordinates.parts().end(),
                     [](const Coordinates::Part& part) { return part.kind == Coordinates::Kind::rotation; });
}

BodyKind body(const plugin::Entry& entry) {
  const std::shared_ptr<const Component> one = forms(entry).front().component;
  return {.type = entry.declaration.name,
          .rows = has<Constrained>(*one),
          .refines = has<Refinable>(*one),
          .rotations = turns_in_space(entry),
          .momentum = has<HasMomentum>(*one),
          .exact_tangent = has<ExactTangent>(*one),
          .surface = has<Surface>(*one),
          .fields = has<HasFields>(*one),
          .theory_limit = has<TheoryLimit>(*one)};
}

}  // namespace

const char* to_string(Correction::Level level) {
  return level == Correction::Level::position   ? "position"
         : level == Correction::Level::velocity ? "velocity"
                                                : "energy";
}

Matrix matrix(plugin::Registry& registry) {
  Matrix all;
  for (Form& form : forms_of(Kind::integrator, registry, taken)) {
    std::vector<Need> needs = taken(*form.component);
    const bool dense = has<DenseOutput>(*form.component), maps = has<Resizable>(*form.component);
    all.integrators.push_back({std::move(form), std::move(needs), dense, maps});
  }
  all.laws = all_pairs(registry);
  const auto of_correction = [](const Component& one) { return std::pair(levels(one), needs_momentum(one)); };
  for (Form& form : forms_of(Kind::correction, registry, of_correction)) {
    std::vector<Correction::Level> corrected = levels(*form.component);
    const bool momentum = needs_momentum(*form.component);
    all.corrections.push_back({std::move(form), std::move(corrected), momentum});
  }
  for (const plugin::Entry* entry : of_kind(Kind::body, registry)) all.bodies.push_back(body(*entry));
  return all;
}

}  // namespace trammel::compatibility
