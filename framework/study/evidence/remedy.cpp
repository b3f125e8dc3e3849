#include "study/evidence/remedy.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/json_file.hpp"
#include "simulate/results/log_file.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"
#include "study/evidence/finer_steps.hpp"
#include "study/trade/methods.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;
using End = RemedySearch::End;

constexpr double past = 0.01;        // of the run: a trial must pass the failure by this
constexpr double tolerance = 1e-8;   // of other methods
constexpr double times_the_run = 3;  // limit of a search, relative to the run's CPU time
constexpr double least_time = 3;     // [s] but at least this

std::vector<Remedy> remedies(const SceneSource& source, plugin::Registry& registry) {
  const FinerSteps finer = finer_steps(source, registry);
  std::vector<Remedy> all = {
      {.what = "finer steps: " + finer.what, .overrides = finer.change},
      {.what = "rows projected at every stage", .overrides = {{"integrator.rows", "projected"}}}};
  std::vector<Method> methods = methods_for(source, registry).capable;
  std::stable_sort(methods.begin(), methods.end(), [](const Method& a, const Method& b) { return a.order > b.order; });
  for (const Method& method : methods)
    if (method.type != finer.type && method.varied == Method::Varied::tolerance)
      all.push_back({.what = fmt::format("another method: {}", method.name),
                     .overrides = {{"integrator", method.with_tolerance(tolerance)}}});
  const long long events = simulate::set_up(source.with(), registry).settings.event_limit;
  all.push_back({.what = fmt::format("{} events allowed in a thousandth of the run", 10 * events),
                 .overrides = {{"simulate.event_limit", fmt::format("{}", 10 * events)}}});
  return all;
}

class Trials {
 public:
  Trials(const SceneSource& source, plugin::Registry& registry, const Failure& failure, const SearchLimits& limits)
      : source_(source), registry_(registry), failed_at_(failure.t), interrupt_(limits.interrupt) {
    const simulate::Settings settings = simulate::set_up(source.with(), registry).settings;
    start_ = settings.start;
    const double behind = failure.last_good ? failure.t - failure.last_good->t : 0;
    enough_ = std::min(settings.until, failed_at_ + std::max(past * (settings.until - settings.start), behind));
    search_.cpu_limit = limits.cpu;
  }

  // False: the search has ended.
  bool go_on(const std::vector<Remedy>& all, const std::optional<State>& from) {
    search_.from = from ? from->t : start_;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!go_on(all[i], i, from)) return false;
    return true;
  }
  RemedySearch take() { return std::move(search_); }

 private:
  bool go_on(Remedy remedy, std::size_t i, const std::optional<State>& from) {
    if (interrupt_ && interrupt_->heed()) return end(End::interrupted);
    // Each trial gets half of the remaining time: a slow one does not prevent the others.
    const double left = search_.cpu_limit - search_.cpu;
    if (left < 0.02 * search_.cpu_limit) return end(End::out_of_time);
    const CaseResult result = run(remedy.overrides, from, left / 2);
    if (result.status == CaseResult::Status::interrupted) return end(End::interrupted);
    search_.cpu += result.cpu + result.cpu_set_up;
    if (result.status == CaseResult::Status::refused) return true;
    if (i >= known_.size()) known_.resize(i + 1);
    if (!known_[i]) known_[i] = true, ++search_.tried;
    if (!result.done() || !(result.t_end > failed_at_) || result.relative_drift > simulate::EnergyWatch::unexplained)
      return true;
    remedy.from = search_.from, remedy.passes = result.t_end;
    search_.remedy = std::move(remedy);
    return end(End::helped);
  }

  CaseResult run(const Overrides& change, const std::optional<State>& from, double cpu_limit) const {
    CaseOptions options;
    options.cpu_limit = cpu_limit, options.start = from, options.enough = enough_, options.interrupt = interrupt_;
    return Batch{source_, registry_, 1, options}({change}).front();
  }

  bool end(End how) {
    search_.end = how;
    return false;
  }

  const SceneSource& source_;
  plugin::Registry& registry_;
  double failed_at_, start_ = 0, enough_ = 0;
  simulate::Interrupt* interrupt_;
  std::vector<bool> known_;  // which changes the scene accepts, by index in the list
  RemedySearch search_;
};

}  // namespace

double search_limit(double cpu_of_run) {
  return std::max(least_time, times_the_run * cpu_of_run);
}

RemedySearch find_remedy(const SceneSource& source, plugin::Registry& registry, const Failure& failure,
                         const SearchLimits& limits) {
  const std::vector<Remedy> all = remedies(source, registry);
  Trials trials(source, registry, failure, limits);
  if (!failure.last_good || trials.go_on(all, failure.last_good)) trials.go_on(all, std::nullopt);
  return trials.take();
}

std::string RemedySearch::sentence() const {
  const std::string of_the_tried = fmt::format("none of the {} change{} tried", tried, tried == 1 ? "" : "s");
  switch (end) {
    case End::helped:
      return fmt::format("Tried from t = {:.6g} s, it passes t = {:.6g} s with {}", remedy->from, remedy->passes,
                         remedy->what);
    case End::nothing_helped:
      return fmt::format(
          "No remedy was found: {} gets past there (finer steps, rows projected, other methods, more events; from the "
          "last good state and from the start)",
          of_the_tried);
    case End::out_of_time:
      return fmt::format("No remedy was found in {:.2g} s of CPU time: {} got past there", cpu_limit, of_the_tried);
    case End::interrupted:
      return fmt::format("The search for a remedy was interrupted: {} had got past there", of_the_tried);
  }
  return "";
}

json RemedySearch::to_json() const {
  json all = {{"found", remedy.has_value()}, {"tried", tried}, {"sentence", sentence()}};
  if (!remedy) return all;
  json set = json::object();
  for (const scene::Override& o : remedy->overrides) set[o.path] = o.value;
  all.update({{"what", remedy->what}, {"set", set}, {"from", remedy->from}, {"passes", remedy->passes}});
  return all;
}

std::string record(const RemedySearch& search, const std::filesystem::path& folder) {
  json result = report::json_file(folder / "result.json");
  result["remedy"] = search.to_json();
  const std::string text = result.dump(2) + "\n";
  simulate::write_whole(folder / "result.json", text);
  return text;
}

}  // namespace trammel::study
