#include "compatibility/forms.hpp"

#include <fmt/format.h>

#include "plugin/describe.hpp"
#include "plugin/guard.hpp"

namespace trammel::compatibility {
namespace {

bool prepared(const plugin::Entry& entry, Component& component) {
  return plugin::guard(entry.origin(""), "prepare", {}, [&] {
    try {
      component.prepare(World{});
      return true;
    } catch (const ParameterError&) {
      return false;
    }
  });
}

}  // namespace

std::string Form::name() const {
  return parameter.empty() ? type : fmt::format("{} with {} {}", type, parameter, choice);
}

std::vector<Form> forms(const plugin::Entry& entry) {
  const Declaration& declaration = entry.declaration;
  std::unique_ptr<Component> usual = plugin::new_component(entry);
  std::vector<Form> all;
  std::vector<Form> others;
  for (const Parameter& parameter : declaration.parameters)
    for (const std::string& choice : parameter.choices) {
      const ParameterValue value = parameter.get(*usual);
      if (const auto* at_default = std::get_if<std::string>(&value); at_default && *at_default == choice) continue;
      std::unique_ptr<Component> other = plugin::new_component(entry);
      parameter.set(*other, choice);
      if (prepared(entry, *other)) others.push_back({declaration.name, parameter.name, choice, std::move(other)});
    }
  prepared(entry, *usual);
  all.push_back({declaration.name, "", "", std::move(usual)});
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace trammel::compatibility
