#include "simulate/start/setup.hpp"

#include <fmt/format.h>

#include "diagnose/redundancy.hpp"
#include "model/build.hpp"
#include "model/scene_keys.hpp"
#include "plugin/describe.hpp"
#include "plugin/parameters.hpp"
#include "simulate/contact/contact_reach.hpp"
#include "simulate/pictures/field_line.hpp"
#include "simulate/start/blame.hpp"
#include "simulate/start/crash_witness.hpp"
#include "simulate/start/initial_state.hpp"
#include "simulate/start/integrator_choice.hpp"
#include "simulate/start/latch_reach.hpp"
#include "simulate/start/law_checks.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {
namespace {

using scene::Problems;
using scene::Value;

// Names of the installed integrators that accept rows.
template <class Can>
std::string integrators_that(plugin::Registry& registry, Can can) {
  std::string names;
  for (const plugin::Entry* entry : registry.all()) {
    if (entry->declaration.kind != Kind::integrator) continue;
    const std::unique_ptr<Component> candidate = plugin::new_component(*entry);
    const auto* integrator = dynamic_cast<const Integrator*>(candidate.get());
    if (integrator && can(*integrator)) names += (names.empty() ? "" : ", ") + entry->declaration.name;
  }
  return names.empty() ? "none found" : names;
}

// The component of a model that has rows or makes some during the run; empty: none.
std::string source_of_rows(const model::Model& model) {
  if (const std::vector<model::RowGroup> groups = model::row_groups(model); !groups.empty())
    return fmt::format("{} has {}", groups.front().path, groups.front().count == 1 ? "a row" : "rows");
  for (const model::ContactEntry& contact : model.contacts) {
    if (contact.restitution) return fmt::format("{} is a row while it is closed", contact.path());
    if (contact.coulomb && contact.coulomb->decide() == SetValuedFriction::Decide::at_events)
      return fmt::format("the friction of {} sticks in a row", contact.path());
  }
  return "";
}

void check_takes_rows(const Value& value, plugin::Registry& registry, const Setup& setup, Problems& problems) {
  if (setup.integrator->traits().rows) return;
  const std::string source = source_of_rows(*setup.model);
  if (source.empty()) return;
  problems.error(value.problem(
      fmt::format("\"{}\" takes no rows, but {}; integrators that take them: {}", setup.integrator_type, source,
                  integrators_that(registry, [](const Integrator& one) { return one.traits().rows; }))));
}

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
  for (const model::ContactEntry& contact : setup.model->contacts)
    if (contact.coulomb && contact.coulomb->decide() == SetValuedFriction::Decide::every_evaluation &&
        setup.integrator->traits().implicit)
      problems.error(
          value.problem(fmt::format("the friction of contacts.{} is decided at every evaluation, which takes an "
                                    "explicit method such as runge_kutta_4",
                                    contact.name)));
  check_takes_rows(value, registry, setup, problems);
  if (dynamic_cast<const ErrorEstimate*>(setup.integrator.get())) return;
  const auto estimates = [](const Integrator& one) { return dynamic_cast<const ErrorEstimate*>(&one) != nullptr; };
  for (const auto& [key, choice] :
       {std::pair{"step", &setup.settings.step}, std::pair{"contact_step", &setup.settings.contact_step}})
    if (const Value* step = value.find(key); step && !choice->fixed)
      problems.error(step->problem(
          fmt::format("\"{}\" cannot estimate its error, so it takes fixed steps only; those that can: {}",
                      setup.integrator_type, integrators_that(registry, estimates))));
}

// Pictures are asked for: some body must have fields.
void check_fields(const Value& root, const model::Model& model, plugin::Registry& registry, Problems& problems) {
  const Value* asked = root.at_path("record.fields");
  if (!asked || FieldLine(model).possible()) return;
  std::string names;
  for (const plugin::Entry* entry : registry.all()) {
    if (entry->declaration.kind != Kind::body) continue;
    const std::unique_ptr<Component> candidate = plugin::new_component(*entry);
    if (dynamic_cast<const HasFields*>(candidate.get())) names += (names.empty() ? "" : ", ") + entry->declaration.name;
  }
  problems.error(asked->problem(
      fmt::format("no body of this scene has fields; those that do: {}", names.empty() ? "none found" : names)));
}

std::string that_correct(Correction::Level level, plugin::Registry& registry) {
  std::string names;
  for (const plugin::Entry* entry : registry.all()) {
    if (entry->declaration.kind != Kind::correction) continue;
    const std::unique_ptr<Component> candidate = plugin::new_component(*entry);
    const auto* correction = dynamic_cast<const Correction*>(candidate.get());
    if (correction && correction->corrects(level)) names += (names.empty() ? "" : ", ") + entry->declaration.name;
  }
  return names.empty() ? "none found" : names;
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
    setup.corrections.push_back({level, std::move(made.component), std::move(made.origin)});
  }
}

// The start must be inside every component's domain. Other failures there are reported by the run, with time and
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

// Finds the state to start from: the first calls of bodies, joints, forces and contacts.
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
  }
  if (problems.empty()) setup.columns = read_observables(root, *setup.model, problems);
  if (problems.empty()) check_fields(root, *setup.model, registry, problems);
  if (problems.empty()) check_laws(root, registry, setup.settings.start, setup.settings.until, problems);
  problems.throw_if_any();
  for (const std::string& file : registry.files()) setup.plugins.push_back(plugin::identify(file));
  model::AssembledSystem system(setup.model);
  const Watch watch(witness, setup, system, {&setup.settings.start, nullptr});
  blaming(setup, system, root, setup.settings.start, [&] {
    find_start(setup, system, root, problems);
    if (purpose == Purpose::motion && !root.find("integrator"))
      choose_integrator(setup, system, chosen_before, registry, problems);
  });
  problems.throw_if_any();
  for (const scene::Problem& warning : problems.warnings()) setup.warnings.push_back(warning.text());
  return setup;
}

}  // namespace trammel::simulate
