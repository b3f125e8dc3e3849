#include "simulate/start/setup.hpp"

#include <fmt/format.h>
#include <trammel/own_tolerances.hpp>

#include "compatibility/integrator_check.hpp"
#include "compatibility/scene_check.hpp"
#include "diagnose/redundancy.hpp"
#include "diagnose/turned_boundaries.hpp"
#include "model/build.hpp"
#include "model/scene_keys.hpp"
#include "plugin/describe.hpp"
#include "plugin/parameters.hpp"
#include "run/contact_scale.hpp"
#include "simulate/contact/contact_reach.hpp"
#include "simulate/pictures/field_line.hpp"
#include "simulate/start/blame.hpp"
#include "simulate/start/crash_witness.hpp"
#include "simulate/start/initial_state.hpp"
#include "simulate/start/integrator_choice.hpp"
#include "simulate/start/latch_reach.hpp"
#include "simulate/start/law_checks.hpp"
#include "simulate/start/laws_of_scene.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {
namespace {

using scene::Problems;
using scene::Value;

void read_integrator(const Value& root, plugin::Registry& registry, Setup& setup, Problems& problems) {
  if (const Value* statics = root.find("static"); statics && !root.find("integrator"))
    return problems.error(
        statics->problem("this scene is made for 'trammel static'; to run it, give it an \"integrator\""));
  const Value& value = integrator_entry(root);
  auto made = plugin::make<Integrator>(registry, Kind::integrator, value, setup.model->world, problems);
  if (!made.component) return;
  setup.integrator = std::move(made.component);
  setup.integrator_origin = std::move(made.origin);
  if (const Value* type = value.find("type")) setup.integrator_type = type->read_text(problems).value_or("");
  compatibility::check_integrator({*setup.integrator, value, setup.integrator_type}, *setup.model, setup.settings,
                                  registry, problems);
}

// If fields are to be recorded, some body must have them.
void check_fields(const Value& root, const model::Model& model, plugin::Registry& registry, Problems& problems) {
  const Value* asked = root.at_path("record.fields");
  if (!asked || FieldLine(model).possible()) return;
  problems.error(asked->problem(
      fmt::format("no body of this scene has fields; those that do: {}",
                  compatibility::names_that<HasFields>(registry, Kind::body, [](const HasFields&) { return true; }))));
}

std::string that_correct(Correction::Level level, plugin::Registry& registry) {
  return compatibility::names_that<Correction>(registry, Kind::correction,
                                               [level](const Correction& one) { return one.corrects(level); });
}

// "corrections": {"position": "minimum_norm", "velocity": {"type": "minimum_norm", ...}, "energy": true}
void read_corrections(const Value& root, plugin::Registry& registry, Setup& setup, Problems& problems) {
  const Value* corrections = root.find("corrections");
  if (!corrections || !model::check_keys(*corrections, {"position", "velocity", "energy"}, problems)) return;
  using Level = Correction::Level;
  for (const auto& [part, level] :
       {std::pair{"position", Level::position}, {"velocity", Level::velocity}, {"energy", Level::energy}}) {
    const Value* value = corrections->find(part);
    if (!value) continue;
    if (value->type() == Value::Type::boolean && !value->boolean()) continue;
    const plugin::Entry* entry = nullptr;
    if (value->type() == Value::Type::object) {
      entry = plugin::entry_of(registry, Kind::correction, *value, problems);
    } else if (value->type() == Value::Type::boolean) {
      try {
        entry = &registry.find(Kind::correction, part);
      } catch (const plugin::UnknownComponent& e) {
        problems.error(value->problem(e.what()));
      }
    } else {
      entry = registry.find(Kind::correction, *value, problems);
    }
    if (!entry) continue;
    auto made = plugin::make<Correction>(*entry, *value, setup.model->world, problems);
    if (!made.component) continue;
    if (!made.component->corrects(level))
      problems.error(value->problem(fmt::format("\"{}\" does not correct the {}; those that do: {}",
                                                entry->declaration.name, part, that_correct(level, registry))));
    compatibility::check_momentum(*made.component, *value, *setup.model, registry, problems);
    setup.corrections.push_back({level, std::move(made.component), std::move(made.origin)});
  }
}

// Throws if the start is outside a component's domain. The run itself reports other failures there, with time and
// results.
void check_domain(model::AssembledSystem& system, const State& start) {
  try {
    system.move_to(start.t, start.q, start.v);
    system.f();
  } catch (const OutsideDomain&) {
    throw;
  } catch (...) {
  }
}

// Finds the initial state. This makes the first calls of bodies, joints, forces and contacts.
void find_start(Setup& setup, model::AssembledSystem& system, const Value& root, Problems& problems) {
  State start;
  start.t = setup.settings.start;
  system.initial(start.q, start.v);
  check_reach(system, start, root, problems);
  problems.throw_if_any();
  setup.initial = initial_state(system, setup.settings.start, setup.settings.initial, root, problems);
  problems.throw_if_any();
  check_domain(system, setup.initial);
  check_latches(system, setup.initial, setup.settings.until, root, problems);
  problems.throw_if_any();
  check_bearing_loads(system, setup.initial, root, problems);
  begin_columns(setup.columns, system, setup.initial);
}

// Gives the integrator the scene's length as its unit, from the start alone so that a resumed run has the same.
void set_length_unit(Setup& setup, model::AssembledSystem& system) {
  auto* const own = dynamic_cast<OwnTolerances*>(setup.integrator.get());
  if (!own) return;
  system.move_to(setup.initial.t, setup.initial.q, setup.initial.v);
  ContactScale all(system.model());
  all.take_all(system);
  own->in_unit(all.scene().in_own_unit({.relative = 1, .absolute = 0}, setup.settings.every).absolute);
}

}  // namespace

Setup set_up(const scene::Scene& scene, plugin::Registry& registry, Purpose purpose, CrashWitness* witness,
             const std::string& chosen_before) {
  const Value& root = scene.root();
  Setup setup;
  for (const scene::Problem& warning : scene.warnings()) setup.warnings.push_back(warning.text());
  Problems problems;
  if (root.type() != Value::Type::object) {
    problems.error(root.problem(fmt::format("found {}, expected a scene: an object", root.type_name())));
    problems.throw_if_any();
  }
  registry.search_scene(root, problems);
  setup.settings = read_settings(root, purpose, problems);
  setup.model = model::build(root, registry, problems);
  if (purpose == Purpose::motion) {
    read_integrator(root, registry, setup, problems);
    read_corrections(root, registry, setup, problems);
    compatibility::check_steps(*setup.model, setup.settings, root, problems);
  } else {
    compatibility::check_statics(*setup.model, root, registry, problems);
  }
  if (problems.empty()) setup.columns = read_observables(root, *setup.model, problems);
  if (problems.empty()) check_fields(root, *setup.model, registry, problems);
  if (problems.empty()) check_laws(root, registry, setup.settings.start, setup.settings.until, problems);
  problems.throw_if_any();
  setup.model->laws = laws_of_scene(root, registry);
  setup.plugins = registry.identities();
  model::AssembledSystem system(setup.model);
  const WitnessScope scope(witness, setup, system, {&setup.settings.start, nullptr});
  blaming(setup, system, root, setup.settings.start, [&] {
    find_start(setup, system, root, problems);
    if (setup.integrator)
      compatibility::check_redundant_rows({*setup.integrator, integrator_entry(root), setup.integrator_type}, system,
                                          setup.initial, registry, problems);
    if (purpose == Purpose::motion && !root.find("integrator"))
      choose_integrator(setup, system, chosen_before, registry, problems);
    set_length_unit(setup, system);
    for (std::string& sentence : turned_boundaries(system, setup.initial, setup.settings.until))
      setup.warnings.push_back(std::move(sentence));
  });
  problems.throw_if_any();
  for (const scene::Problem& warning : problems.warnings()) setup.warnings.push_back(warning.text());
  return setup;
}

}  // namespace trammel::simulate
