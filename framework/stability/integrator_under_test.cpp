#include "stability/integrator_under_test.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "plugin/parameters.hpp"

namespace trammel::stability {

IntegratorUnderTest::IntegratorUnderTest(plugin::Registry& registry, std::string name,
                                         std::vector<scene::Override> settings)
    : registry_(&registry),
      name_(std::move(name)),
      settings_(std::move(settings)),
      entry_(&registry.find(Kind::integrator, name_)) {
  maker()();  // all problems of the settings now
}

std::string IntegratorUnderTest::described() const {
  std::string text;
  for (const scene::Override& s : settings_)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", s.path, s.value);
  return text.empty() ? name_ : fmt::format("{} ({})", name_, text);
}

std::string IntegratorUnderTest::object() const {
  const std::string bare = nlohmann::json{{"type", name_}}.dump();
  return nlohmann::json::parse(scene::Scene::parse(bare, "--set", settings_).resolved()).dump();
}

const std::vector<std::string>& IntegratorUnderTest::choices(const std::string& parameter) const {
  static const std::vector<std::string> none;
  for (const Parameter& p : entry_->declaration.parameters)
    if (p.name == parameter) return p.choices;
  return none;
}

bool IntegratorUnderTest::has_parameter(const std::string& name) const {
  const auto& all = entry_->declaration.parameters;
  return std::any_of(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
}

Maker IntegratorUnderTest::maker(std::vector<scene::Override> more) const {
  std::vector<scene::Override> all = settings_;
  all.insert(all.end(), more.begin(), more.end());
  const std::string object = nlohmann::json{{"type", name_}}.dump();
  return [registry = registry_, scene = scene::Scene::parse(object, "--set", all)] {
    scene::Problems problems;
    auto made = plugin::make<Integrator>(*registry, Kind::integrator, scene.root(), World{}, problems);
    problems.throw_if_any();
    return std::move(made.component);
  };
}

}  // namespace trammel::stability
