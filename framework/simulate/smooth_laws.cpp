#include "simulate/smooth_laws.hpp"

#include <fmt/format.h>

#include "scene/continuity.hpp"

namespace trammel::simulate {
namespace {

using scene::Problems;
using scene::Value;

void check(const Value& component, const plugin::Entry& entry, double begin, double end, Problems& problems) {
  for (const Parameter& parameter : entry.declaration.parameters) {
    const Value* value = component.at_path(parameter.name);
    if (!value || parameter.type != Parameter::Type::time_function || parameter.traits.derivatives == 0) continue;
    Problems ignored;  // reported when the component was made
    const auto law = value->read_time_function(ignored);
    if (!law) continue;
    if (const auto jump = scene::find_jump(*law, parameter.traits.derivatives, begin, end))
      problems.error(
          value->problem(fmt::format("this law must be differentiable, but at t = {:.9g} s its {} jumps by {:.6g}",
                                     jump->t, jump->derivative == 0 ? "value" : "velocity", jump->by)));
  }
}

}  // namespace

void check_laws(const Value& root, plugin::Registry& registry, double begin, double end, Problems& problems) {
  for (const auto& [group, kind] :
       {std::pair{"bodies", Kind::body}, std::pair{"joints", Kind::joint}, std::pair{"forces", Kind::force}}) {
    const Value* components = root.find(group);
    if (!components || components->type() != Value::Type::object) continue;
    for (const auto& [name, component] : components->members()) {
      Problems ignored;
      if (const plugin::Entry* entry = plugin::entry_of(registry, kind, component, ignored))
        check(component, *entry, begin, end, problems);
    }
  }
}

}  // namespace trammel::simulate
