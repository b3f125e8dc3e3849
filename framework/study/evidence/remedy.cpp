#include "study/evidence/remedy.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulate/start/setup.hpp"
#include "study/evidence/finer_steps.hpp"
#include "study/json_text.hpp"
#include "study/trade/methods.hpp"

namespace trammel::study {
namespace {

constexpr double past = 0.01;       // of the run
constexpr double tolerance = 1e-8;  // of other methods

std::vector<Remedy> remedies(const SceneSource& source, plugin::Registry& registry) {
  const FinerSteps finer = finer_steps(source, registry);
  std::vector<Remedy> all = {{"finer steps: " + finer.what, finer.change},
                             {"rows projected at every stage", {{"integrator.rows", "projected"}}}};
  for (const Method& method : methods_for(source, registry).capable)
    if (method.type != finer.type && method.dial == Method::Dial::tolerance)
      all.push_back(
          {fmt::format("another method: {}", method.name), {{"integrator", method.with_tolerance(tolerance)}}});
  return all;
}

// A scene that does not take the change is refused, which is a failure like others.
bool passes(const SceneSource& source, plugin::Registry& registry, Overrides change, double failed_at, double until,
            double limit) {
  change.push_back({"simulate.until", fmt::format("{:.17g}", until)});
  CaseOptions options;
  options.cpu_limit = limit;
  try {
    const CaseResult result = run_case(source.with(change), registry, options);
    return result.done() && result.t_end > failed_at;
  } catch (const scene::SceneError&) {
    return false;
  }
}

}  // namespace

std::optional<Remedy> find_remedy(const SceneSource& source, plugin::Registry& registry, double failed_at,
                                  double limit) {
  const simulate::Settings settings = simulate::set_up(source.with(), registry).settings;
  const double until = std::min(settings.until, failed_at + past * (settings.until - settings.start));
  for (const Remedy& remedy : remedies(source, registry))
    if (passes(source, registry, remedy.overrides, failed_at, until, limit)) return remedy;
  return std::nullopt;
}

}  // namespace trammel::study
