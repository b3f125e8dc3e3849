#include "compatibility/integrator_check.hpp"

#include <fmt/format.h>

#include "compatibility/demands.hpp"
#include "compatibility/forms.hpp"
#include "compatibility/neighbours.hpp"
#include "diagnose/redundancy.hpp"

namespace trammel::compatibility {
namespace {

std::string those_that_take(Need need, plugin::Registry& registry) {
  return names_that<Integrator>(registry, Kind::integrator, [need](const Integrator& one) { return takes(one, need); });
}

// The choice in the scene without which the same method accepts it; empty: there is none.
std::string refusing_choice(const ChosenIntegrator& chosen, Need need, plugin::Registry& registry) {
  const std::vector<Form> all = forms(registry.find(Kind::integrator, chosen.type));
  const auto taken = [need](const Form& form) { return takes(dynamic_cast<const Integrator&>(*form.component), need); };
  if (!taken(all.front())) return "";
  for (const Form& form : all) {
    const scene::Value* value = chosen.value.at_path(form.parameter);
    if (!form.parameter.empty() && value && value->type() == scene::Value::Type::text && value->text() == form.choice &&
        !taken(form))
      return fmt::format(" with \"{}\": \"{}\"", form.parameter, form.choice);
  }
  return "";
}

void refuse(const ChosenIntegrator& chosen, Need need, const std::string& cause, plugin::Registry& registry,
            scene::Problems& problems) {
  problems.error(chosen.value.problem(fmt::format("\"{}\"{} takes no {}, but {}; integrators that do: {}", chosen.type,
                                                  refusing_choice(chosen, need, registry), noun(need), cause,
                                                  those_that_take(need, registry))));
}

void check_error_estimate(const ChosenIntegrator& chosen, const simulate::Settings& settings,
                          plugin::Registry& registry, scene::Problems& problems) {
  if (takes(chosen.method, Need::error_estimate)) return;
  for (const auto& [key, choice] :
       {std::pair{"step", &settings.step}, std::pair{"contact_step", &settings.contact_step}})
    if (const scene::Value* step = chosen.value.find(key); step && !choice->fixed)
      problems.error(step->problem(
          fmt::format("\"{}\" cannot estimate its error, so it takes fixed steps only; those that can: {}", chosen.type,
                      those_that_take(Need::error_estimate, registry))));
}

}  // namespace

void check_integrator(const ChosenIntegrator& chosen, const model::Model& model, const simulate::Settings& settings,
                      plugin::Registry& registry, scene::Problems& problems) {
  for (const Demand& demand : demands(model))
    if (!takes(chosen.method, demand.need)) refuse(chosen, demand.need, demand.cause, registry, problems);
  check_error_estimate(chosen, settings, registry, problems);
}

void check_redundant_rows(const ChosenIntegrator& chosen, model::AssembledSystem& system, const State& start,
                          plugin::Registry& registry, scene::Problems& problems) {
  if (takes(chosen.method, Need::redundant_rows)) return;
  const std::vector<simulate::RedundantRows> found = simulate::redundant_rows(system, start);
  if (!found.empty()) refuse(chosen, Need::redundant_rows, simulate::description(found.front()), registry, problems);
}

}  // namespace trammel::compatibility
