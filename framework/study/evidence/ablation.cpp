#include "study/evidence/ablation.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "simulate/start/setup.hpp"
#include "study/trade/errors.hpp"
#include "study/trade/fidelity_study.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

constexpr double least_limit = 1;  // [s] of CPU time for a scene without a part; longer runs: times_longer
constexpr double times_longer = 5;

void without_each(std::vector<Part>& all, const json& written, const char* group) {
  if (!written.contains(group) || !written[group].is_object()) return;
  for (const auto& [name, entry] : written[group].items()) {
    const std::string path = fmt::format("{}.{}", group, name);
    all.push_back({.what = "without " + path, .change = {path, "null"}, .worst = ""});
    if (group == std::string("joints") && entry.is_object() && entry.contains("friction"))
      all.push_back({.what = "without friction of " + path, .change = {path + ".friction", "null"}, .worst = ""});
  }
}

std::vector<Part> optional_parts(const SceneSource& source, plugin::Registry& registry) {
  const scene::Scene scene = source.with();
  const json written = json::parse(scene.resolved());  // units that "for" repeats are one part here
  std::vector<Part> all;
  if (written.contains("gravity"))
    all.push_back({.what = "without gravity", .change = {"gravity", "null"}, .worst = ""});
  for (const char* group : {"forces", "contacts", "joints"}) without_each(all, written, group);
  for (const Rung& rung : ladders(source, registry))
    if (!rung.finer) all.push_back({.what = rung.what, .change = rung.change, .worst = ""});
  return all;
}

// Why the scene cannot be set up with the change; empty: it can. An observable of a part requires the part.
std::string refusal(const SceneSource& source, plugin::Registry& registry, const Part& part) {
  const std::string observe = "record.observe.";
  try {
    simulate::set_up(source.with({part.change}), registry);
    return "";
  } catch (const scene::SceneError& e) {
    std::vector<std::string> columns;
    for (const scene::Problem& p : e.problems())
      if (p.path.starts_with(observe)) columns.push_back(p.path.substr(observe.size()));
    if (!columns.empty() && columns.size() == e.problems().size())
      return fmt::format("it is observed: {}", fmt::join(columns, ", "));
    return e.problems().front().message;
  } catch (const std::exception& e) {
    return e.what();
  }
}

// Runs the scene without each of the parts, and first the complete scene, for its time under the same conditions.
std::vector<CaseResult> run_all(const Batch& batch, std::vector<Part>& parts) {
  std::vector<Overrides> cases = {{}};
  for (Part& part : parts)
    if (part.failure = refusal(batch.source, batch.registry, part); part.failure.empty())
      cases.push_back({part.change});
  return batch(cases);
}

CaseResult own_run(const SceneSource& source, plugin::Registry& registry) {
  simulate::set_up(source.with(), registry);  // SceneError, which differs from a failed run
  CaseResult own = run_case(source.with(), registry);
  if (!own.done()) throw std::runtime_error("the scene itself does not run to its end: " + own.reason);
  if (own.series.names.empty())
    throw std::runtime_error("the scene observes nothing: add \"record\": {\"observe\": {...}}");
  return own;
}

void judge(Part& part, const CaseResult& result, const Measure& measure) {
  part.cpu = result.cpu;
  if (!result.done()) {
    part.failure = result.reason.substr(0, result.reason.find_first_of(";\n"));
    return;
  }
  const Error e = measure.error(result.series, measure.end());
  part.difference = std::max(e.max, e.multipliers), part.worst = e.worst;
}

// Among rungs of one ladder the cheapest one that keeps the target.
std::vector<Part> candidates(const std::vector<Part>& parts, double target) {
  std::vector<Part> cheap;
  for (const Part& part : parts)
    if (part.failure.empty() && part.difference <= target) cheap.push_back(part);
  std::stable_sort(cheap.begin(), cheap.end(), [](const Part& a, const Part& b) { return a.cpu < b.cpu; });
  std::vector<std::string> taken;
  std::erase_if(cheap, [&](const Part& part) {
    const std::string& path = part.change.path;
    if (std::any_of(taken.begin(), taken.end(), [&](const std::string& other) { return overlap(path, other); }))
      return true;
    taken.push_back(path);
    return false;
  });
  std::stable_sort(cheap.begin(), cheap.end(),
                   [](const Part& a, const Part& b) { return a.difference < b.difference; });
  return cheap;
}

// Leaves out all candidates at once; while that misses the target, the most important one is restored.
void find_smallest(Ablation& a, const SceneSource& source, plugin::Registry& registry, const Measure& measure,
                   const CaseOptions& options) {
  for (a.left_out = candidates(a.parts, a.target); !a.left_out.empty(); a.left_out.pop_back()) {
    Overrides change;
    for (const Part& part : a.left_out) change.push_back(part.change);
    Part together{.what = "", .change = {}, .worst = ""};
    judge(together, Batch{source, registry, 1, options}({change}).front(), measure);
    if (!together.failure.empty() || together.difference > a.target) continue;
    a.difference = together.difference, a.cpu_of_smallest = together.cpu;
    return;
  }
  a.cpu_of_smallest = a.cpu;
}

}  // namespace

Ablation ablate(const SceneSource& source, plugin::Registry& registry, double target, int jobs) {
  const CaseResult own = own_run(source, registry);
  const Measure measure(own, {}, source.with());
  CaseOptions options;
  options.cpu_limit = std::max(least_limit, times_longer * own.cpu);
  Ablation a{.cpu = own.cpu, .parts = optional_parts(source, registry), .target = target, .left_out = {}};
  const std::vector<CaseResult> results = run_all({source, registry, jobs, options}, a.parts);
  a.cpu = results.front().cpu;
  std::size_t next = 1;
  for (Part& part : a.parts)
    if (part.failure.empty()) judge(part, results[next++], measure);
  std::stable_sort(a.parts.begin(), a.parts.end(), [](const Part& x, const Part& y) {
    return std::pair(!x.failure.empty(), x.difference) < std::pair(!y.failure.empty(), y.difference);
  });
  find_smallest(a, source, registry, measure, options);
  return a;
}

report::Page page_of(const Ablation& a, const std::string& scene) {
  report::Page page{.title = "What the parts of " + scene + " are worth", .sentences = {}, .figures = {}, .tables = {}};
  if (a.left_out.empty()) {
    page.sentences.push_back(
        fmt::format("Every part is needed, or changes the observables by more than {:g}: keep all.", a.target));
  } else {
    std::vector<std::string> sets;
    for (const Part& part : a.left_out)
      sets.push_back(fmt::format("--set '{}={}'", part.change.path, part.change.value));
    page.sentences.push_back(fmt::format(
        "The smallest scene that keeps {:g} changes the observables by {:.2g} and takes {:.2g} times the CPU "
        "time: {}",
        a.target, a.difference, a.cpu > 0 ? a.cpu_of_smallest / a.cpu : 1, fmt::join(sets, " ")));
  }
  report::Table table{.title = "Left out, one at a time",
                      .columns = {{"part", ""},
                                  {"largest change", "of what the observable changes"},
                                  {"observable", ""},
                                  {"CPU time", "of the scene as it is"}},
                      .rows = {}};
  for (const Part& part : a.parts)
    table.rows.push_back({part.what, part.failure.empty() ? fmt::format("{:.2g}", part.difference) : "needed",
                          part.failure.empty() ? part.worst : part.failure,
                          a.cpu > 0 && part.failure.empty() ? fmt::format("{:.2f}", part.cpu / a.cpu) : "-"});
  page.tables.push_back(std::move(table));
  return page;
}

}  // namespace trammel::study
