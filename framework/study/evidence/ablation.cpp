#include "study/evidence/ablation.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/trade/errors.hpp"
#include "study/trade/fidelity_study.hpp"

namespace trammel::study {
namespace {

constexpr double least_limit = 1;  // [s] of CPU time for a scene without a part; longer runs: times_longer
constexpr double times_longer = 5;

void without_each(std::vector<Part>& all, const scene::Scene& scene, const char* group) {
  const scene::Value* entries = scene.root().find(group);
  if (!entries || entries->type() != scene::Value::Type::object) return;
  for (const auto& member : entries->members()) {
    const std::string path = fmt::format("{}.{}", group, member.first);
    all.push_back({.what = "without " + path, .change = {path, "null"}, .worst = ""});
  }
}

void without_joint_friction(std::vector<Part>& all, const scene::Scene& scene) {
  const scene::Value* joints = scene.root().find("joints");
  if (!joints || joints->type() != scene::Value::Type::object) return;
  for (const auto& [name, joint] : joints->members())
    if (joint.type() == scene::Value::Type::object && joint.find("friction"))
      all.push_back({.what = fmt::format("without friction of joints.{}", name),
                     .change = {fmt::format("joints.{}.friction", name), "null"},
                     .worst = ""});
}

std::vector<Part> optional_parts(const SceneSource& source, plugin::Registry& registry) {
  const scene::Scene scene = source.with();
  std::vector<Part> all;
  if (scene.root().find("gravity"))
    all.push_back({.what = "without gravity", .change = {"gravity", "null"}, .worst = ""});
  without_each(all, scene, "forces");
  without_each(all, scene, "contacts");
  without_joint_friction(all, scene);
  for (const Rung& rung : ladders(source, registry))
    if (!rung.finer) all.push_back({.what = rung.what, .change = rung.change, .worst = ""});
  return all;
}

// The scene as it is runs with each of the parts left out, and the same scene twice: first of all, for its own time.
std::vector<CaseResult> run_all(const Batch& batch, const std::vector<Part>& parts) {
  std::vector<Overrides> cases;
  for (const Part& part : parts) cases.push_back({part.change});
  return batch(cases);
}

CaseResult own_run(const SceneSource& source, plugin::Registry& registry) {
  CaseResult own = run_case(source.with(), registry);
  if (!own.done()) throw std::runtime_error("the scene itself does not run to its end: " + own.reason);
  if (own.series.names.empty())
    throw std::runtime_error("the scene observes nothing: add \"record\": {\"observe\": {...}}");
  return own;
}

void judge(Part& part, const CaseResult& result, const Measure& measure) {
  part.cpu = result.cpu;
  if (!result.done()) {
    part.failure = result.reason;
    return;
  }
  const Error e = measure.error(result.series, measure.end());
  part.difference = std::max(e.max, e.multipliers), part.worst = e.worst;
}

// Of rungs of one ladder the cheapest that keeps the target.
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

// All candidates at once; while that misses the target the one that matters most comes back.
void find_smallest(Ablation& a, const SceneSource& source, plugin::Registry& registry, const Measure& measure,
                   const CaseOptions& options) {
  for (a.left_out = candidates(a.parts, a.target); !a.left_out.empty(); a.left_out.pop_back()) {
    Overrides change;
    for (const Part& part : a.left_out) change.push_back(part.change);
    Part together{.what = "", .change = {}, .worst = ""};
    judge(together, run_case(source.with(change), registry, options), measure);
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
  for (std::size_t i = 0; i < a.parts.size(); ++i) judge(a.parts[i], results[i], measure);
  std::stable_sort(a.parts.begin(), a.parts.end(), [](const Part& x, const Part& y) {
    return std::pair(!x.failure.empty(), x.difference) < std::pair(!y.failure.empty(), y.difference);
  });
  find_smallest(a, source, registry, measure, options);
  return a;
}

report::Page page_of(const Ablation& a, const std::string& scene) {
  report::Page page{.title = "What the parts of " + scene + " are worth", .sentences = {}, .figures = {}, .tables = {}};
  if (a.left_out.empty()) {
    page.sentences.push_back(fmt::format("Every part changes the observables by more than {:g}: keep all.", a.target));
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
    table.rows.push_back({part.what, part.failure.empty() ? fmt::format("{:.2g}", part.difference) : "fails",
                          part.failure.empty() ? part.worst : part.failure,
                          a.cpu > 0 && part.failure.empty() ? fmt::format("{:.2f}", part.cpu / a.cpu) : "-"});
  page.tables.push_back(std::move(table));
  return page;
}

}  // namespace trammel::study
