#include "simulate/smooth_laws.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "scene/continuity.hpp"

namespace trammel::simulate {
namespace {

using scene::Problems;
using scene::Value;

// The first of some instants at which the law or one of its derivatives is no number, and which of them.
std::optional<std::pair<double, const char*>> find_not_finite(const TimeFunction& law, int derivatives, double begin,
                                                              double end) {
  constexpr int parts = 256;
  for (int i = 0; i <= parts; ++i) {
    const double t = begin + (end - begin) * i / parts;
    const TimeFunction::Jet jet = law.jet(t);
    if (!std::isfinite(jet.value)) return std::pair{t, "value"};
    if (derivatives > 0 && !std::isfinite(jet.rate)) return std::pair{t, "velocity"};
    if (derivatives > 1 && !std::isfinite(jet.second)) return std::pair{t, "acceleration"};
  }
  return {};
}

void check(const Value& component, const plugin::Entry& entry, double begin, double end, Problems& problems) {
  for (const Parameter& parameter : entry.declaration.parameters) {
    const Value* value = component.at_path(parameter.name);
    if (!value || parameter.type != Parameter::Type::time_function || parameter.traits.derivatives == 0) continue;
    Problems ignored;  // reported when the component was made
    const auto law = value->read_time_function(ignored);
    if (!law) continue;
    if (const auto at = find_not_finite(*law, parameter.traits.derivatives, begin, end)) {
      problems.error(
          value->problem(fmt::format("at t = {:.9g} s the {} of this law is not finite", at->first, at->second)));
      continue;
    }
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
