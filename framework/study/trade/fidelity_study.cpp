#include "study/trade/fidelity_study.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <trammel/fidelity.hpp>

#include "plugin/parameters.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::study {
namespace {

void add(std::vector<Rung>& all, const std::string& path, const std::string& value, bool finer) {
  all.push_back({fmt::format("{} = {}", path, value), {path, value}, finer, true});
}

void of_choice(std::vector<Rung>& all, const FidelityParameter& p, const std::string& path, const std::string& now) {
  const auto found = std::find(p.choices.begin(), p.choices.end(), now);
  if (found == p.choices.end()) return;
  for (auto at = p.choices.begin(); at != p.choices.end(); ++at)
    if (at < found || at == found + 1) add(all, path, *at, at > found);
}

void of_integer(std::vector<Rung>& all, const FidelityParameter& p, const std::string& path, int now) {
  const bool larger = p.costs == FidelityParameter::Costs::more_if_larger;
  const int up = now + std::max(1, now / 2), down = now - 1, half = now / 2;
  add(all, path, std::to_string(larger ? up : down), true);
  if (down >= 0) add(all, path, std::to_string(larger ? down : up), false);
  if (larger && half >= 1 && half < down) add(all, path, std::to_string(half), false);
}

void of_number(std::vector<Rung>& all, const FidelityParameter& p, const std::string& path, double now) {
  const double finer = p.costs == FidelityParameter::Costs::more_if_larger ? 10 : 0.1;
  add(all, path, fmt::format("{}", now * finer), true);
  for (const double factor : {1 / finer, 1 / (finer * finer)}) add(all, path, fmt::format("{}", now * factor), false);
}

void of_component(std::vector<Rung>& all, const Component* component, Kind kind, const std::string& path,
                  const scene::Scene& scene, plugin::Registry& registry) {
  const auto* has = dynamic_cast<const HasFidelity*>(component);
  const scene::Value* type = scene.root().at_path(path + ".type");
  if (!has || !type) return;
  const Declaration& declaration = registry.find(kind, type->text()).declaration;
  for (const FidelityParameter& p : has->fidelity())
    for (const Parameter& parameter : declaration.parameters) {
      if (parameter.name != p.name) continue;
      const ParameterValue value = parameter.get(*component);
      const std::string at = path + "." + p.name;
      if (const auto* text = std::get_if<std::string>(&value)) of_choice(all, p, at, *text);
      if (const int* n = std::get_if<int>(&value)) of_integer(all, p, at, *n);
      if (const double* x = std::get_if<double>(&value)) of_number(all, p, at, *x);
    }
}

// Units that were repeated by "for" have no path of their own.
bool applies(const SceneSource& source, const Rung& rung) {
  try {
    source.with({rung.change});
    return true;
  } catch (const scene::SceneError&) {
    return false;
  }
}

}  // namespace

std::vector<Rung> ladders(const SceneSource& source, plugin::Registry& registry) {
  std::vector<Rung> all;
  const scene::Scene scene = source.with();
  const simulate::Setup setup = simulate::set_up(scene, registry);
  for (const model::BodyEntry& body : setup.model->bodies)
    of_component(all, body.body.get(), Kind::body, "bodies." + body.name, scene, registry);
  for (const model::ContactEntry& contact : setup.model->contacts) {
    if (contact.joint) continue;
    of_component(all, contact.law.get(), Kind::contact, "contacts." + contact.name, scene, registry);
    if (contact.friction)
      all.push_back({"without friction of contacts." + contact.name,
                     {"contacts." + contact.name + ".friction", "null"},
                     false,
                     false});
  }
  if (scene.root().find("corrections")) all.push_back({"without corrections", {"corrections", "null"}, false, false});
  std::erase_if(all, [&](const Rung& rung) { return !applies(source, rung); });
  return all;
}

}  // namespace trammel::study
