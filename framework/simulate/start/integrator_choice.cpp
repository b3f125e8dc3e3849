#include "simulate/start/integrator_choice.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "diagnose/fastest_motion.hpp"
#include "diagnose/mass_ratio.hpp"
#include "plugin/parameters.hpp"

namespace trammel::simulate {
namespace {

// Limit of the evaluations of an explicit method, about one per radian of the fastest motion, for at most `few`
// coordinates; with more coordinates each step costs more.
constexpr double most_evaluations = 1e6, few = 10;
// Systems of more coordinates consist of elements. Loads and blows keep their fast waves in motion, and a tight
// tolerance would resolve these waves.
constexpr int many = 100;
// dop853 stabilises rows at 10 1/s (its delta and epsilon), which limits its steps for any motion. A run that is longer
// than `most_of_stabilisation` tenths of a second has slower motions.
constexpr double stabilised_at = 10, most_of_stabilisation = 1e4;  // [1/s]

struct Choice {
  const char* name;
  const char* parameters;
  double tolerance;
};
constexpr Choice explicit_steps = {"dop853", R"({"type": "dop853"})", 1e-9},
                 steps_on_rows = {"dop853 with projected rows", R"({"type": "dop853", "rows": "projected"})", 1e-9},
                 damped_steps = {"hht_alpha", R"({"type": "hht_alpha"})", 1e-7},
                 damped_waves = {"hht_alpha for many coordinates", R"({"type": "hht_alpha"})", 1e-5};

bool decides_friction_at_every_evaluation(const model::Model& model) {
  return std::any_of(model.contacts.begin(), model.contacts.end(), [](const model::ContactEntry& contact) {
    return contact.coulomb && contact.coulomb->decide() == SetValuedFriction::Decide::every_evaluation;
  });
}

bool exceeds_explicit_steps(const FastestMotion& fastest, const Setup& setup) {
  const double time = setup.settings.until - setup.settings.start;
  const double cost = std::max(1.0, setup.model->sizes.nv / few);
  return fastest.rate() * time * cost > most_evaluations && !decides_friction_at_every_evaluation(*setup.model);
}

bool outlasts_stabilisation(const Setup& setup) {
  const model::Model& model = *setup.model;
  const bool rows = model.sizes.nc > 0 || std::any_of(model.contacts.begin(), model.contacts.end(),
                                                      [](const model::ContactEntry& c) { return c.restitution; });
  const double time = setup.settings.until - setup.settings.start;
  return rows && stabilised_at * time > most_of_stabilisation && !decides_friction_at_every_evaluation(model);
}

const Choice& fitting(const FastestMotion& fastest, const MassRatio& ratio, const Setup& setup) {
  if (exceeds_explicit_steps(fastest, setup)) return setup.model->sizes.nv > many ? damped_waves : damped_steps;
  return ratio.is_large() || outlasts_stabilisation(setup) ? steps_on_rows : explicit_steps;
}

std::string reason(const Choice& choice, const FastestMotion& fastest, const MassRatio& ratio, const Setup& setup) {
  if (&choice != &steps_on_rows) return description(fastest, *setup.model);
  if (ratio.is_large()) return description(ratio, *setup.model);
  return fmt::format("rows that are stabilised, at {} 1/s, would ask for {:.0e} steps or more in a run of {:.6g} s",
                     stabilised_at, stabilised_at * (setup.settings.until - setup.settings.start) / 3,
                     setup.settings.until - setup.settings.start);
}

const Choice& named(const std::string& name) {
  for (const Choice* each : {&steps_on_rows, &damped_steps, &damped_waves})
    if (name == each->name) return *each;
  return explicit_steps;
}

void take(const Choice& choice, Setup& setup, plugin::Registry& registry, scene::Problems& problems) {
  const scene::Scene parameters = scene::Scene::parse(choice.parameters, "Trammel's choice of an integrator");
  auto made = plugin::make<Integrator>(registry, Kind::integrator, parameters.root(), setup.model->world, problems);
  if (!made.component) return;
  setup.integrator = std::move(made.component);
  setup.integrator_origin = std::move(made.origin);
  setup.integrator_type = parameters.root().find("type")->text();
  // `absolute` 0: in the scene's own unit, as for a tolerance that a scene gives.
  setup.settings.step.tolerance = setup.settings.contact_step.tolerance = {choice.tolerance, 0};
}

}  // namespace

void choose_integrator(Setup& setup, model::AssembledSystem& system, const std::string& before,
                       plugin::Registry& registry, scene::Problems& problems) {
  FastestMotion fastest;
  try {
    fastest = fastest_motion(system, setup.initial);
  } catch (const model::NotSolvable&) {
    return;  // the run reports it, with its time
  }
  const MassRatio ratio = mass_ratio(*setup.model, setup.initial);
  const Choice& choice = before.empty() ? fitting(fastest, ratio, setup) : named(before);
  if (&choice != &explicit_steps) take(choice, setup, registry, problems);
  setup.chosen = choice.name;
  setup.choice = fmt::format("{}, tolerance {:.3g}: the scene names none, and {}", choice.name, choice.tolerance,
                             reason(choice, fastest, ratio, setup));
}

}  // namespace trammel::simulate
