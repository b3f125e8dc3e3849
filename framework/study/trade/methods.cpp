#include "study/trade/methods.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <trammel/fidelity.hpp>
#include <trammel/methods/oscillating_steps.hpp>

#include "plugin/parameters.hpp"
#include "simulate/start/setup.hpp"
#include "study/cases/json_text.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

std::string family_of(const Integrator& integrator) {
  if (dynamic_cast<const OscillatingSteps*>(&integrator)) return "exponential";
  const Traits traits = integrator.traits();
  if (traits.steps > 1) return "multistep";
  return traits.implicit ? "implicit" : "explicit Runge-Kutta";
}

// The scene's own integrator, if it names one.
json own_integrator(const scene::Scene& scene) {
  const scene::Value* value = scene.root().find("integrator");
  return value && value->type() == scene::Value::Type::object ? json::parse(json_text(*value)) : json();
}

// Why the method does not accept the scene's rows, contacts or friction; empty: it does.
std::string refusal(const SceneSource& source, plugin::Registry& registry, const Method& method) {
  try {
    const scene::Scene scene = source.with(method.overrides(6));
    simulate::set_up(scene, registry);
    return "";
  } catch (const std::exception& e) {
    return e.what();
  }
}

void describe(Method& method, plugin::Registry& registry) {
  const std::unique_ptr<Component> made = registry.find(Kind::integrator, method.type).declaration.make();
  const auto* integrator = dynamic_cast<const Integrator*>(made.get());
  if (!integrator) return;
  method.family = family_of(*integrator), method.order = std::max(1, integrator->traits().order);
  if (method.varied == Method::Varied::step || dynamic_cast<const ErrorEstimate*>(integrator)) return;
  if (const auto* has = dynamic_cast<const HasFidelity*>(integrator))
    for (const FidelityParameter& p : has->fidelity())
      if (p.costs == FidelityParameter::Costs::more_if_smaller) method.tolerances.push_back(p.name);
  if (method.tolerances.empty()) method.varied = Method::Varied::step;
}

// [s] the scene's own fixed step, or a step derived from its records.
double usual_step(const json& own, const simulate::Settings& settings) {
  if (own.is_object() && own.contains("step") && own["step"].is_number()) return own["step"];
  const double thousandth = (settings.until - settings.start) / 1000;
  return settings.every > 0 ? std::min(settings.every, thousandth) : thousandth;
}

}  // namespace

double Method::asked(int level) const {
  return varied == Varied::tolerance ? std::pow(10.0, -2 - level / 2.0) : 4 * step * std::pow(2.0, -level);
}

std::string Method::setting(int level) const {
  return varied == Varied::tolerance ? fmt::format("tolerance {:.2g}", asked(level))
                                     : fmt::format("step {:.3g} s", asked(level));
}

std::string Method::with_tolerance(double tolerance) const {
  json object = json::parse(integrator);
  const json number = json::parse(fmt::format("{:.3g}", tolerance));
  for (const std::string& parameter : tolerances) object[parameter] = number;
  object["step"] = tolerances.empty() ? json{{"tolerance", number}} : json(step);
  return object.dump();
}

std::string Method::with_level(int level) const {
  if (varied == Varied::tolerance) return with_tolerance(asked(level));
  json object = json::parse(integrator);
  object["step"] = asked(level);
  if (contact_step > 0) object["contact_step"] = contact_step * asked(level) / step;
  return object.dump();
}

Methods methods_for(const SceneSource& source, plugin::Registry& registry) {
  Methods all;
  const scene::Scene scene = source.with();
  const json own = own_integrator(scene);
  const std::string own_type = own.is_object() ? own.value("type", "dop853") : "";
  scene::Problems problems;
  const double usual = usual_step(own, simulate::read_settings(scene.root(), simulate::Purpose::motion, problems));
  const auto consider = [&](Method method) {
    if (method.varied == Method::Varied::tolerance) method.step = usual;
    describe(method, registry);
    if (const std::string reason = refusal(source, registry, method); reason.empty())
      all.capable.push_back(std::move(method));
    else
      all.refused.push_back({method.name, reason.substr(0, reason.find('\n'))});
  };
  if (own.is_object()) {
    json bare = own;
    bare.erase("step"), bare.erase("contact_step");
    bare["type"] = own_type;
    if (own.contains("step") && own["step"].is_number()) {
      Method fixed{
          own_type + ", fixed steps", own_type, "", 1, Method::Varied::step, true, bare.dump(), own["step"], 0};
      if (own.contains("contact_step") && own["contact_step"].is_number()) fixed.contact_step = own["contact_step"];
      consider(fixed);
    }
    consider({own_type, own_type, "", 1, Method::Varied::tolerance, true, bare.dump()});
  }
  for (const plugin::Entry* entry : registry.all())
    if (entry->declaration.kind == Kind::integrator && entry->declaration.name != own_type)
      consider({entry->declaration.name, entry->declaration.name, "", 1, Method::Varied::tolerance, false,
                json{{"type", entry->declaration.name}}.dump()});
  return all;
}

}  // namespace trammel::study
