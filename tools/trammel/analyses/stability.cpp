// trammel stability INTEGRATOR: measured maps of stability and damping, beside theory.
#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "input.hpp"
#include "next.hpp"
#include "report/page.hpp"
#include "simulate/results/log_file.hpp"
#include "stability/page.hpp"
#include "study/samples.hpp"

namespace trammel::tool {

namespace {

constexpr Option kOfMethod{"--set", "NAME=VALUE", "a parameter of the integrator, e.g. alpha=-0.3 (repeatable)"};

constexpr Option kStabilityReport{"--report", "FILE", "write the figures as one HTML file to look at"};
constexpr Option kScene{"--scene", "SCENE", "the largest step with which this scene stays bounded"};
constexpr Option kOver{"--over", "PATH=A,B,...",
                       "of --scene: for each of these values of the scene (repeatable: every combination)"};

// "bodies.b.mass=1,2,3"
std::vector<scene::Override> values_over(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(fmt::format("--over {}: expected PATH=A,B,..., e.g. --over parameters.k=1e2,1e4,1e6", text));
  std::vector<scene::Override> values;
  std::istringstream in(text.substr(equals + 1));
  for (std::string value; std::getline(in, value, ',');) values.push_back({text.substr(0, equals), value});
  return values;
}

// Every combination of the values of each --over; the last one's vary fastest.
std::vector<study::Overrides> changes_of(const Arguments& arguments) {
  std::vector<std::vector<scene::Override>> over;
  std::vector<std::size_t> lengths;
  for (const std::string& text : arguments.all(kOver.name)) {
    over.push_back(values_over(text));
    lengths.push_back(over.back().size());
    const std::string& path = over.back().front().path;
    for (std::size_t i = 0; i + 1 < over.size(); ++i)
      if (over[i].front().path == path)
        throw UsageError(fmt::format("--over {0} is given twice: give all its values at once, {0}=A,B,...", path));
  }
  std::vector<study::Overrides> changes;
  for (const std::vector<std::size_t>& chosen : study::grid(lengths)) {
    study::Overrides& change = changes.emplace_back();
    for (std::size_t i = 0; i < chosen.size(); ++i) change.push_back(over[i][chosen[i]]);
  }
  return changes;
}

// The operand may be a library with one integrator, as for `trammel check`.
std::string integrator_in(const std::string& operand, plugin::Registry& registry) {
  if (std::error_code error; !std::filesystem::is_regular_file(operand, error)) return operand;
  plugin::Registry alone(plugin::Registry::Start::empty);
  alone.search(operand);
  std::vector<std::string> names;
  for (const plugin::Entry* entry : alone.all())
    if (entry->declaration.kind == Kind::integrator) names.push_back(entry->declaration.name);
  if (names.empty()) throw UsageError(fmt::format("{} has no integrator", operand));
  if (names.size() > 1)
    throw UsageError(fmt::format("{0} has several integrators: trammel stability NAME --plugin {0}, NAME one of {1}",
                                 operand, fmt::join(names, ", ")));
  registry.search(operand);
  return names.front();
}

report::Page page_of(const Arguments& arguments, plugin::Registry& registry) {
  const stability::IntegratorUnderTest subject(registry, integrator_in(arguments.operand(), registry),
                                               overrides_of(arguments));
  if (!arguments.has(kScene.name)) {
    if (arguments.has(kOver.name)) throw UsageError("--over needs --scene: its values are of a scene");
    return stability::measure(subject);
  }
  return stability::measure_on_scene(subject, study::SceneSource(arguments.last(kScene.name)), registry,
                                     changes_of(arguments));
}

Exit stability(const Arguments& arguments) {
  plugin::Registry registry;
  load_plugins(arguments, registry);
  const report::Page page = page_of(arguments, registry);
  if (arguments.has("--json")) {
    print_json({{"page", report::to_json(page)}});
    return Exit::done;
  }
  if (arguments.has(kStabilityReport.name))
    simulate::write_whole(arguments.last(kStabilityReport.name), report::html(page));
  fmt::print("{}\n\n", report::text(page));
  print_next(arguments, {"trammel", "check", arguments.operand()}, {kPlugin});
  return Exit::done;
}

}  // namespace

Command stability_command() {
  return {"stability",
          "INTEGRATOR|LIB",
          "Measure where a method is stable, what it damps, and how it holds rows at small steps, beside theory.",
          {kOfMethod, kScene, kOver, kStabilityReport, kPlugin, kJson},
          stability};
}

}  // namespace trammel::tool
