#include "commands/result.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/component_cost.hpp"
#include "simulate/results/provenance.hpp"
#include "simulate/results/series_columns.hpp"

namespace trammel::simulate {
namespace {

using json = nlohmann::ordered_json;

json counts(Simulator& simulator) {
  const Statistics& s = simulator.statistics();
  const model::Counts& c = simulator.system().counts();
  return {{"steps", s.steps},
          {"contact_steps", s.contact_steps},
          {"rejected", s.rejected},
          {"locating_steps", s.locating_steps},
          {"residual_evaluations", c.residual_evaluations},
          {"jacobian_evaluations", c.jacobian_evaluations},
          {"factorizations", c.factorizations},
          {"newton_iterations", c.newton_iterations},
          {"events", s.events},
          {"impacts", s.impacts},
          {"touches", s.touches}};
}

json sizes(const Statistics& statistics) {
  json list = json::array();
  for (const Statistics::SizesAt& at : statistics.sizes)
    list.push_back({{"t", at.t}, {"nq", at.sizes.nq}, {"nv", at.sizes.nv}, {"nc", at.sizes.nc}});
  return list;
}

json dissipated(const model::Model& model, const Ledger& ledger, double drift) {
  json impact = json::object();
  for (std::size_t i = 0; i < ledger.impacts().size(); ++i)
    if (const model::ContactEntry& c = model.contacts[i]; c.restitution || (c.joint && c.coulomb))
      impact[c.joint ? c.path() : c.name] = ledger.impacts()[i];
  json friction = json::object(), joint_friction = json::object();
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    if (const model::ContactEntry& c = model.contacts[i]; c.friction || (c.surface && c.surface->friction))
      (c.joint ? joint_friction : friction)[c.name] = ledger.friction()[Eigen::Index(i)];
  return {{"impact", impact},
          {"impact_total", ledger.impact_total()},
          {"contact_damping", ledger.contact_damping()},
          {"friction", friction},
          {"joint_friction", joint_friction},
          {"friction_total", ledger.friction().sum()},
          {"dampers", ledger.dampers()},
          {"numerical", -drift}};
}

json energies(const model::Model& model, Simulator& simulator) {
  const Ledger& ledger = simulator.ledger();
  const Energy end = simulator.last_energy();
  const double drift = end.total() - ledger.energy();
  return {{"energy_start", ledger.energy_start()},
          {"energy_end", to_json(end)},
          {"energy_supplied",
           {{"drives", ledger.drives()},
            {"constraints", ledger.constraints()},
            {"moving_markers", ledger.markers()},
            {"total", ledger.supplied()}}},
          {"energy_of_refinements", ledger.refinements()},
          {"energy_drift", drift},
          {"energy_dissipated", dissipated(model, ledger, drift)}};
}

std::vector<std::string> all_warnings(const Setup& setup, const Simulator& simulator) {
  std::vector<std::string> all = simulator.doubts();
  all.insert(all.end(), setup.warnings.begin(), setup.warnings.end());
  all.insert(all.end(), simulator.warnings().begin(), simulator.warnings().end());
  return all;
}

// Contacts whose forces were not unique, with the first and the last time [s] of a record or event at which this was
// seen.
json indeterminate_contacts(const model::Model& model, const ContactAudit& audit) {
  json contacts = json::object();
  for (const auto& [contact, span] : audit.indeterminate())
    contacts[model.contacts[std::size_t(contact)].name] = {{"first", span.first}, {"last", span.last}};
  return contacts;
}

}  // namespace

json to_json(const Energy& e) {
  return {{"kinetic", e.kinetic}, {"potential", e.potential}, {"elastic", e.elastic}, {"total", e.total()}};
}

json columns_json(const Setup& setup, Recorder::Books books) {
  const auto entry = [](std::string_view name, const Quantity& quantity) {
    return json{{"name", name}, {"unit", quantity.unit}, {"meaning", quantity.meaning}, {"path", quantity.path}};
  };
  json series = json::array(), events = json::array();
  const auto add = [&](const auto& names) {
    for (const std::string_view name : names) series.push_back(entry(name, fixed_quantity(name)));
  };
  series.push_back(entry("t", fixed_quantity("t")));
  for (const Column& column : setup.columns) series.push_back(entry(column.name, column.quantity));
  add(energy_columns);
  if (books == Recorder::Books::kept) add(book_columns);
  add(norm_columns);
  if (books == Recorder::Books::kept) add(step_columns);
  const EventLine event_line(*setup.model);
  for (const std::string& name : event_line.columns()) events.push_back(entry(name, event_quantity(name)));
  return {{"series", std::move(series)}, {"events", std::move(events)}};
}

json drawing_json(model::AssembledSystem& system, const State& state) {
  try {
    system.move_to(state.t, state.q, state.v);
    return still_picture(system);
  } catch (const std::exception&) {
    return json::object();
  }
}

std::string title_of(const scene::Scene& scene) {
  const scene::Value* title = scene.root().find("title");
  return title && title->type() == scene::Value::Type::text ? title->text() : scene.file();
}

json result_head(const scene::Scene& scene, const Setup& setup, const Outcomes& outcomes) {
  const bool titled = scene.root().find("title") != nullptr;
  json head = {{"trammel_result", 1},
               {"status", to_string(outcomes.status)},
               {"reason", outcomes.reason},
               {"scene", scene.file()},
               {"title", titled ? title_of(scene) : ""},
               {"scene_hash", fmt::format("{:016x}", scene.hash())}};
  head.update(provenance(scene, outcomes.command, setup.plugins));
  return head;
}

const char* to_string(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::failed:
      return "failed";
    case Status::interrupted:
      return "interrupted";
  }
  return "";
}

std::string result_json(const scene::Scene& scene, const Setup& setup, Simulator& simulator, const Outcomes& outcomes) {
  const Statistics& statistics = simulator.statistics();
  const State& state = simulator.state();
  const json balance = energies(*setup.model, simulator);
  json result = result_head(scene, setup, outcomes);
  result.update(json{{"warnings", all_warnings(setup, simulator)},
                     {"integrator", setup.integrator_type},
                     {"integrator_choice", setup.choice},
                     {"t_start", setup.settings.start},
                     {"t_end", state.t},
                     {"t_until", setup.settings.until},
                     {"wall_time_s", outcomes.cost.wall},
                     {"cpu_time_s", outcomes.cost.cpu},
                     {"resumed", outcomes.resumed},
                     {"counts", counts(simulator)},
                     {"smallest_step", statistics.smallest_step},
                     {"largest_step", statistics.largest_step}});
  result.update(balance);
  result.update(json{{"statically_indeterminate", indeterminate_contacts(*setup.model, simulator.audit())},
                     {"constraint_maxima",
                      {{"position", statistics.largest.position},
                       {"velocity", statistics.largest.velocity},
                       {"acceleration", statistics.largest.acceleration}}},
                     {"sizes", sizes(statistics)},
                     {"sizes_left_out", statistics.sizes_left_out},
                     {"cost_by_component",
                      outcomes.status == Status::done ? component_costs(simulator.system(), state) : json::array()},
                     {"columns", columns_json(setup, Recorder::Books::kept)},
                     {"drawing", drawing_json(simulator.system(), state)}});
  return result.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace trammel::simulate
