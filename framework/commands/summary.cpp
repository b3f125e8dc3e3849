#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/result.hpp"

namespace trammel::simulate {
namespace {

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// Compliant contacts have no impacts: they touch.
std::string impacts_of(const model::Model& model, const Statistics& s) {
  const bool rigid = std::any_of(model.contacts.begin(), model.contacts.end(),
                                 [](const model::ContactEntry& contact) { return contact.restitution != nullptr; });
  return rigid ? counted(std::size_t(s.impacts), "impact", "impacts") + ", " : "";
}

std::string causes(const model::Model& model, const Ledger& ledger, double drift) {
  std::string text;
  const auto add = [&text](const std::string& cause, double energy) {
    if (energy != 0) text += fmt::format("{}{} {:.6g} J", text.empty() ? "" : ", ", cause, energy);
  };
  for (std::size_t i = 0; i < ledger.impacts().size(); ++i)
    add("impacts of " + model.contacts[i].name, ledger.impacts()[i]);
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    add("friction of " + (model.contacts[i].joint ? model.contacts[i].path() : model.contacts[i].name),
        ledger.friction()[Eigen::Index(i)]);
  add("contact damping", ledger.contact_damping());
  add("dampers", ledger.dampers());
  add("refinements", -ledger.refinements());
  add("numerical", -drift);
  return text.empty() ? "nothing" : text;
}

}  // namespace

std::string summary(const scene::Scene& scene, const Setup& setup, Simulator& simulator, const Outcomes& outcomes,
                    const std::filesystem::path& folder) {
  const model::Model& model = *setup.model;
  const auto contacts = std::size_t(std::count_if(model.contacts.begin(), model.contacts.end(),
                                                  [](const model::ContactEntry& contact) { return !contact.joint; }));
  const Statistics& s = simulator.statistics();
  const Ledger& ledger = simulator.ledger();
  const State& state = simulator.state();
  std::string text = title_of(scene) + "\n";
  const auto line = [&text](const char* what, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", what, value);
  };
  // Warnings come first: they limit how far the other lines can be trusted.
  for (const std::string& warning : simulator.doubts()) line("warning", warning);
  for (const std::string& warning : simulator.warnings()) line("warning", warning);
  for (const std::string& warning : setup.warnings) line("warning", warning);
  line("simulated",
       fmt::format("{:.6g} s to {:.6g} s with {}; {}, {}, {}", setup.settings.start, state.t, setup.integrator_type,
                   counted(model.bodies.size(), "body", "bodies"), counted(model.joints.size(), "joint", "joints"),
                   counted(contacts, "contact", "contacts")));
  if (!setup.choice.empty()) line("integrator", setup.choice);
  if (contacts > 0)
    line("contact", fmt::format("{}{}, {} in all, {} of {} steps in contact", impacts_of(model, s),
                                counted(std::size_t(s.touches), "touch", "touches"),
                                counted(std::size_t(s.events), "event", "events"), s.contact_steps, s.steps));
  if (const double end = simulator.last_energy().total(); std::isfinite(end))
    line("energy", fmt::format("{:.9g} J -> {:.9g} J; supplied {:.6g} J; lost to {}", ledger.energy_start(), end,
                               ledger.supplied(), causes(model, ledger, end - ledger.energy())));
  if (s.largest.position > 0 || s.largest.velocity > 0 || s.largest.acceleration > 0)
    line("constraints", fmt::format("largest norms: position {:.3g}, velocity {:.3g}, acceleration {:.3g}",
                                    s.largest.position, s.largest.velocity, s.largest.acceleration));
  const double per_step = s.steps > 0 ? 1e6 * outcomes.cost.cpu / double(s.steps) : 0;
  line("cost", fmt::format("{} steps, {} rejected, {} to locate events; {:.3g} s of CPU time, {:.3g} us per step",
                           s.steps, s.rejected, s.locating_steps, outcomes.cost.cpu, per_step));
  line("results", folder.string());
  if (!outcomes.reason.empty()) line(to_string(outcomes.status), outcomes.reason);
  return text;
}

}  // namespace trammel::simulate
