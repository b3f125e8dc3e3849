#include "simulate/start/laws_of_scene.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "scene/laws/law_code.hpp"

namespace trammel::simulate {
namespace {

using scene::LawOfTime;
using scene::Problems;
using scene::Value;

void visit_parameters(const Value& component, const Declaration& declaration, const EachLaw& each) {
  for (const Parameter& parameter : declaration.parameters) {
    const Value* value = component.at_path(parameter.name);
    if (!value) continue;
    if (parameter.type == Parameter::Type::named_parts && value->type() == Value::Type::object)
      for (const auto& [name, part] : value->members()) visit_parameters(part, *parameter.part, each);
    if (parameter.type != Parameter::Type::time_function) continue;
    Problems ignored;  // reported when the component was made
    const std::optional<TimeFunction> law = value->read_time_function(ignored);
    if (law && !law->is_constant()) each(*value, *law, parameter);
  }
}

void visit_component(const Value* component, Kind kind, plugin::Registry& registry, const EachLaw& each) {
  Problems ignored;
  if (!component || component->type() != Value::Type::object) return;
  if (const plugin::Entry* entry = plugin::entry_of(registry, kind, *component, ignored))
    visit_parameters(*component, entry->declaration, each);
}

bool equal_laws(const LawOfTime& a, const LawOfTime& b) {
  return a.derivatives == b.derivatives && a.is_angle == b.is_angle && a.law.code()->equals(*b.law.code());
}

}  // namespace

void for_each_law(const Value& root, plugin::Registry& registry, const EachLaw& each) {
  for (const auto& [group, kind] : {std::pair{"bodies", Kind::body}, std::pair{"joints", Kind::joint},
                                    std::pair{"forces", Kind::force}, std::pair{"contacts", Kind::contact}}) {
    const Value* components = root.find(group);
    if (!components || components->type() != Value::Type::object) continue;
    for (const auto& [name, component] : components->members()) {
      visit_component(&component, kind, registry, each);
      if (component.type() != Value::Type::object || (kind != Kind::joint && kind != Kind::contact)) continue;
      visit_component(component.find("friction"), Kind::friction, registry, each);
      if (kind == Kind::contact) visit_component(component.find("reaches"), Kind::joint, registry, each);
    }
  }
}

std::vector<LawOfTime> laws_of_scene(const Value& root, plugin::Registry& registry) {
  std::vector<LawOfTime> laws;
  for_each_law(root, registry, [&laws](const Value&, const TimeFunction& law, const Parameter& parameter) {
    const LawOfTime found{law, parameter.traits.derivatives, std::strcmp(parameter.traits.unit, "rad") == 0};
    const auto same = [&found](const LawOfTime& other) { return equal_laws(found, other); };
    if (std::none_of(laws.begin(), laws.end(), same)) laws.push_back(found);
  });
  return laws;
}

}  // namespace trammel::simulate
