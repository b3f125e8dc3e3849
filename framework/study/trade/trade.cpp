#include "study/trade/trade.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "scene/suggestion.hpp"
#include "simulate/start/setup.hpp"
#include "study/trade/trade_content.hpp"

namespace trammel::study {
namespace {

constexpr double usual_target = 1e-4;  // for the horizon, if none is given
// Settings that take less than this many times the cheapest are repeated for the spread of their times.
constexpr double on_front = 1.5;
constexpr double worthwhile = 0.9;  // of the choice's CPU time: a rung that takes more saves nothing

class Trade {
 public:
  Trade(const SceneSource& source, plugin::Registry& registry, const TradeOptions& options)
      : options_(options),
        scene_(source.with()),
        run_(source, registry, options.budget, options.jobs, options.interrupt, [this] { show(); }),
        content_{source, options, {}, {}, "", 0, {}, 0, 0, {}, {}, {}, {}, {}, {}, "", 0, 0} {}

  TradeReport operator()() {
    begin("asking the integrators");
    content_.methods = methods_for(run_.source(), run_.registry());
    begin("looking for a reference");
    const double target = options_.target.value_or(usual_target);
    content_.reference = find_reference(content_.methods, run_, target, options_.observe, content_.no_reference);
    if (content_.reference) measure_all(target);
    content_.cpu = run_.spent(), content_.runs = run_.runs();
    return write_trade(content_, run_.registry());
  }

 private:
  void begin(const std::string& what) {
    now_ = what;
    show();
  }

  void show() const {
    if (options_.progress)
      options_.progress(run_.spent() / run_.budget(), fmt::format("{}, {} runs", now_, run_.runs()));
  }

  void measure_all(double target) {
    const TradeReference& reference = *content_.reference;
    const Measure measure(reference.first.result, options_.observe, scene_);
    WorkPrecision wp(content_.methods, reference, measure, run_);
    content_.target = std::max(target, reference.floor());
    begin("running the methods");
    const bool adaptive = options_.target && options_.search == TradeOptions::Search::adaptive;
    adaptive ? wp.search(content_.target) : wp.scan(options_.target ? 1 : 2);
    content_.search_runs = wp.runs(), content_.full_grid = wp.full_grid();
    begin("repeating what is near the front");
    wp.repeat(content_.target, on_front);
    content_.courses = wp.courses();
    if (options_.target) choose(wp, measure);
  }

  // Chooses the cheapest setting whose claim holds against both references. The second reference is of another family
  // than the first, so that no setting is judged by its own family only.
  void choose(const WorkPrecision& wp, const Measure& measure) {
    std::vector<std::pair<double, std::pair<std::size_t, int>>> meeting;
    for (std::size_t i = 0; i < wp.courses().size(); ++i)
      for (const auto& [level, s] : wp.courses()[i].samples)
        if (s.done() && s.error.max <= content_.target) meeting.push_back({s.cpu.least, {i, level}});
    std::sort(meeting.begin(), meeting.end());
    for (const auto& [cpu, which] : meeting) {
      const Method& method = wp.courses()[which.first].method;
      begin("verifying " + method.name + ", " + method.setting(which.second));
      const std::vector<CaseResult> again = run_({method.overrides(which.second)}, std::max(1.0, 10 * cpu));
      if (!again[0].done()) continue;
      const double error = claimed(again[0], measure);
      if (error > content_.target) continue;
      content_.choice = Choice{
          method.name + ", " + method.setting(which.second), method.overrides(which.second), error, cpu, 0, 0, false};
      std::set<std::size_t> named;
      for (const auto& [other, there] : meeting)
        if (there.first != which.first && named.insert(there.first).second && other <= wp.sample(which).cpu.most)
          content_.equal.push_back(wp.courses()[there.first].method.name + ", " +
                                   wp.courses()[there.first].method.setting(there.second));
      judge(method, which.second, again[0], measure);
      return;
    }
  }

  // The references may be wrong as well, on the same side, by their floor: ten times their disagreement.
  double claimed(const CaseResult& result, const Measure& measure) const {
    const TradeReference& r = *content_.reference;
    const double measured = std::max(measure.error(result.series, r.trusted_until).max,
                                     measure.error(result.series, r.second.result.series, r.trusted_until).max);
    return measured + r.floor();
  }

  void judge(const Method& method, int level, const CaseResult& result, const Measure& measure) {
    own_scene(measure);
    separate(method, level, result, measure);
    ensembles(measure);
    fidelity(result, measure);
  }

  void own_scene(const Measure& measure) {
    begin("running the scene as it is");
    const std::vector<CaseResult> own = run_({Overrides{}}, std::max(1.0, run_.left() / 3));
    Choice& choice = *content_.choice;
    choice.own_done = own[0].done(), choice.own_cpu = own[0].cpu;
    if (choice.own_done) choice.own_error = measure.error(own[0].series, content_.reference->trusted_until).max;
  }

  void separate(const Method& method, int level, const CaseResult& result, const Measure& measure) {
    SeparateErrors errors;
    const double until = content_.reference->trusted_until;
    errors.integration = measure.error(result.series, until).max;
    const scene::Value* contacts = scene_.root().find("contacts");
    if (contacts && contacts->type() == scene::Value::Type::object && !contacts->members().empty()) {
      begin("separating the treatment of contacts");
      Overrides finer = method.overrides(level);
      const double asked = method.asked(level);
      finer.push_back(
          {"integrator.contact_step",
           method.varied == Method::Varied::tolerance
               ? fmt::format("{{\"tolerance\": {:.3g}}}", asked / 100)
               : fmt::format("{}", (method.contact_step > 0 ? method.contact_step / method.step : 1) * asked / 8)});
      const std::vector<CaseResult> fine = run_({finer}, std::max(1.0, 20 * result.cpu));
      if (fine[0].done()) {
        errors.contact = measure.error(result.series, fine[0].series, until).max;
        errors.integration = measure.error(fine[0].series, until).max;
      }
    }
    content_.separate = errors;
  }

  void fidelity(const CaseResult& result, const Measure& measure) {
    begin("trying other models");
    const double until = content_.reference->trusted_until;
    const std::vector<Rung> rungs = ladders(run_.source(), run_.registry());
    if (rungs.empty() || run_.left() <= 0) return;
    std::vector<Overrides> cases;
    for (const Rung& rung : rungs) {
      cases.push_back(content_.choice->overrides);
      cases.back().push_back(rung.change);
    }
    const std::vector<CaseResult> results =
        run_(cases, std::max(4 * result.cpu, run_.left() / double(2 * cases.size())));
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      const double difference = results[i].done() ? measure.error(results[i].series, result.series, until).max : 0;
      content_.rungs.push_back({rungs[i], results[i].status, results[i].reason, difference, results[i].cpu});
      if (rungs[i].finer && results[i].done())
        content_.separate->truncation = std::max(content_.separate->truncation.value_or(0), difference);
    }
    take_cheaper(result, measure);
  }

  // Rungs that save time and leave the error below the target, the cheapest first.
  std::vector<const RungResult*> usable_rungs(double cpu) const {
    std::vector<const RungResult*> usable;
    for (const RungResult& r : content_.rungs)
      if (!r.rung.finer && r.status == CaseResult::Status::done && r.cpu < worthwhile * cpu &&
          r.difference + content_.choice->error <= content_.target)
        usable.push_back(&r);
    std::sort(usable.begin(), usable.end(), [](const auto* a, const auto* b) { return a->cpu < b->cpu; });
    return usable;
  }

  // Takes the cheapest usable rung of each ladder; a run with all of them must meet the target.
  void take_cheaper(const CaseResult& result, const Measure& measure) {
    Choice& choice = *content_.choice;
    Overrides all = choice.overrides;
    std::vector<std::string> what;
    for (const RungResult* r : usable_rungs(result.cpu)) {
      const auto same = [&](const scene::Override& o) { return overlap(o.path, r->rung.change.path); };
      if (std::any_of(all.begin(), all.end(), same)) continue;
      all.push_back(r->rung.change), what.push_back(r->rung.what);
    }
    if (what.empty()) return;
    const std::vector<CaseResult> together = run_({all}, std::max(1.0, 2 * result.cpu));
    if (!together[0].done() || claimed(together[0], measure) > content_.target) return;
    choice.overrides = all, choice.cpu = together[0].cpu, choice.error = claimed(together[0], measure);
    content_.dropped = what;
  }

  void ensembles(const Measure& measure) {
    const TradeReference& r = *content_.reference;
    if (!r.chaotic) return;
    begin("comparing distributions beyond the horizon");
    const Method& method = r.first.method;
    const double tolerance = std::max(r.first.tolerance, loosest_reference);  // no trajectory has to be resolved
    const double cpu = r.first.result.cpu * std::pow(r.first.tolerance / tolerance, 1.0 / (method.order + 1));
    content_.distributions = compare_ensembles(content_.choice->overrides, content_.choice->cpu,
                                               {{"integrator", method.with_tolerance(tolerance)}}, cpu, measure, run_);
    if (content_.distributions.empty())
      content_.no_distributions = fmt::format(
          "beyond the horizon nothing is claimed: {:.3g} s of CPU time are left, and 4 perturbed starts of the "
          "choice and of the reference take {:.3g} s (--budget gives more)",
          std::max(0.0, run_.left()), 4 * (content_.choice->cpu + cpu));
  }

  const TradeOptions& options_;
  scene::Scene scene_;
  Runner run_;
  std::string now_;
  TradeContent content_;
};

}  // namespace

void require_observed(const SceneSource& source, plugin::Registry& registry, const std::vector<std::string>& names) {
  const scene::Scene scene = source.with();
  const simulate::Setup setup = simulate::set_up(scene, registry);
  scene::Problems problems;
  std::vector<std::string> known;
  for (const simulate::Column& column : setup.columns) known.push_back(column.name);
  const scene::Value* observe = scene.root().at_path("record.observe");
  const scene::Value& at = observe ? *observe : scene.root();
  if (known.empty()) problems.error(at.problem("the scene observes nothing to compare: record.observe names columns"));
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      problems.error(at.problem(fmt::format("the scene observes no \"{}\"{}", name, scene::did_you_mean(name, known))));
  problems.throw_if_any();
}

TradeReport trade(const SceneSource& source, plugin::Registry& registry, const TradeOptions& options) {
  return Trade(source, registry, options)();
}

}  // namespace trammel::study
