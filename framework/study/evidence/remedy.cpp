#include "study/evidence/remedy.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulate/start/setup.hpp"
#include "study/cases/json_text.hpp"
#include "study/evidence/finer_steps.hpp"
#include "study/trade/methods.hpp"

namespace trammel::study {
namespace {

constexpr double past = 0.01;       // of the run
constexpr double tolerance = 1e-8;  // of other methods

std::vector<Remedy> remedies(const SceneSource& source, plugin::Registry& registry) {
  const FinerSteps finer = finer_steps(source, registry);
  std::vector<Remedy> all = {
      {.what = "finer steps: " + finer.what, .overrides = finer.change},
      {.what = "rows projected at every stage", .overrides = {{"integrator.rows", "projected"}}}};
  for (const Method& method : methods_for(source, registry).capable)
    if (method.type != finer.type && method.dial == Method::Dial::tolerance)
      all.push_back({.what = fmt::format("another method: {}", method.name),
                     .overrides = {{"integrator", method.with_tolerance(tolerance)}}});
  return all;
}

class Trials {
 public:
  Trials(const SceneSource& source, plugin::Registry& registry, double failed_at, double limit)
      : source_(source), registry_(registry), failed_at_(failed_at) {
    const simulate::Settings settings = simulate::set_up(source.with(), registry).settings;
    start_ = settings.start;
    until_ = std::min(settings.until, failed_at + past * (settings.until - settings.start));
    options_.cpu_limit = limit;
  }

  std::optional<Remedy> first_of(const std::vector<Remedy>& all, const std::optional<State>& from) {
    options_.start = from;
    for (Remedy remedy : all) {
      if (!passes(remedy.overrides)) continue;
      remedy.from = from ? from->t : start_;
      return remedy;
    }
    return std::nullopt;
  }

 private:
  // A scene that does not take the change is refused, which is a failure like others.
  bool passes(Overrides change) {
    change.push_back({"simulate.until", fmt::format("{:.17g}", until_)});
    try {
      const CaseResult result = run_case(source_.with(change), registry_, options_);
      return result.done() && result.t_end > failed_at_;
    } catch (const scene::SceneError&) {
      return false;
    }
  }

  const SceneSource& source_;
  plugin::Registry& registry_;
  double failed_at_, start_ = 0, until_ = 0;
  CaseOptions options_;
};

}  // namespace

std::optional<Remedy> find_remedy(const SceneSource& source, plugin::Registry& registry, const Failure& failure,
                                  double limit) {
  Trials trials(source, registry, failure.t, limit);
  const std::vector<Remedy> all = remedies(source, registry);
  if (failure.last_good)
    if (auto remedy = trials.first_of(all, failure.last_good)) return remedy;
  return trials.first_of(all, std::nullopt);
}

}  // namespace trammel::study
