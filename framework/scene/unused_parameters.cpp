// A parameter that was set on the command line and is not used most likely belongs to another scene.
#include <set>

#include "scene/builder.hpp"
#include "scene/expression.hpp"

namespace trammel::scene {

namespace {

// Adds the names that expressions in `value` use.
void add_names(const Value& value, std::set<std::string_view>& names) {
  if (value.type() == Value::Type::text && value.text().starts_with("=")) {
    for (const std::string_view name : names_in(value.text())) names.insert(name);
  } else if (value.type() == Value::Type::array) {
    for (const Value& item : value.items()) add_names(item, names);
  } else if (value.type() == Value::Type::object) {
    for (const auto& [key, member] : value.members()) add_names(member, names);
  }
}

// Names used directly or through other parameters.
std::set<std::string_view> used_parameters(const Value& root, const Value& parameters) {
  std::set<std::string_view> used;
  for (const auto& [key, value] : root.members())
    if (&value != &parameters) add_names(value, used);
  for (std::size_t before = 0; used.size() != before;) {
    before = used.size();
    for (const auto& [name, value] : parameters.members())
      if (used.contains(name)) add_names(value, used);
  }
  return used;
}

}  // namespace

std::vector<Problem> set_in_vain(const Value& root, const std::vector<Override>& overrides) {
  std::vector<Problem> warnings;
  const Value* parameters = root.find("parameters");
  if (!parameters || overrides.empty()) return warnings;
  const auto used = used_parameters(root, *parameters);
  std::set<std::string_view> named;
  for (const Override& override : overrides)
    for (const auto& [name, value] : parameters->members())
      if (override.path == "parameters." + name && !used.contains(name) && named.insert(name).second)
        warnings.push_back(value.problem("has no effect: nothing in this scene uses it"));
  return warnings;
}

}  // namespace trammel::scene
