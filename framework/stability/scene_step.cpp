#include "stability/scene_step.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "diagnose/fastest_motion.hpp"
#include "simulate/start/equilibrium.hpp"
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

namespace trammel::stability {
namespace {

using json = nlohmann::ordered_json;
using study::CaseOptions;
using study::CaseResult;
using study::Overrides;

constexpr double unbounded = 10;  // relative to the energies of the accurate run
constexpr double exact_tolerance = 1e-8;
constexpr int shortest = 14;   // halvings of the longest step, a tenth of the run
constexpr int bisections = 7;  // to a hundredth

double largest_energy(const CaseResult& r) {
  double most = 0;
  const auto kinetic = r.series.column("energy_kinetic"), elastic = r.series.column("energy_elastic");
  for (std::size_t row = 0; row < r.series.rows(); ++row) {
    const double energy = (kinetic ? r.series.at(row, *kinetic) : 0) + (elastic ? r.series.at(row, *elastic) : 0);
    if (!std::isfinite(energy)) return std::numeric_limits<double>::infinity();
    most = std::max(most, energy);
  }
  return most;
}

class StepSearch {
 public:
  StepSearch(const study::SceneSource& source, plugin::Registry& registry, const std::string& integrator,
             const Overrides& change)
      : source_(source), registry_(registry), integrator_(json::parse(integrator)), change_(change) {
    options_.keep = study::SeriesSink::Keep::energies;
  }

  // Why there is no reference; empty: there is one.
  std::string find_reference() {
    Overrides change = change_;
    change.push_back({"integrator", json{{"type", "dop853"}, {"step", {{"tolerance", exact_tolerance}}}}.dump()});
    const CaseResult exact = run_case(source_.with(change), registry_, options_);
    energy_ = largest_energy(exact);
    options_.cpu_limit = std::max(1.0, 20 * exact.cpu);
    return exact.done() ? "" : "dop853 does not reach the end: " + exact.reason;
  }

  bool bounded(double h) {
    json object = integrator_;
    object["step"] = h;
    Overrides change = change_;
    change.push_back({"integrator", object.dump()});
    change.push_back({"record.every", fmt::format("{:.17g}", h)});  // a record ends a step
    const CaseResult r = run_case(source_.with(change), registry_, options_);
    return r.done() && largest_energy(r) <= unbounded * energy_;
  }

 private:
  const study::SceneSource& source_;
  plugin::Registry& registry_;
  json integrator_;
  const Overrides& change_;
  CaseOptions options_;
  double energy_ = 0;
};

// [rad/s] Highest frequency about the start, or about the equilibrium if nothing swings at the start (a pendulum held
// level); 0: nothing swings at either.
double highest_frequency(const simulate::Setup& setup) {
  model::AssembledSystem system(setup.model);
  if (const double omega = simulate::fastest_motion(system, setup.initial).frequency; omega > 0) return omega;
  State rest = setup.initial;
  try {
    return simulate::find_equilibrium(system, rest) ? 0 : simulate::fastest_motion(system, rest).frequency;
  } catch (const std::exception&) {
    return 0;  // a component throws on the way to the equilibrium
  }
}

std::optional<double> predicted(const scene::Scene& scene, plugin::Registry& registry, std::optional<double> limit) {
  if (!limit) return std::nullopt;
  const double omega = highest_frequency(simulate::set_up(scene, registry));
  return omega > 0 ? std::optional(*limit / omega) : std::nullopt;
}

}  // namespace

LargestStep largest_step(const study::SceneSource& source, plugin::Registry& registry, const std::string& integrator,
                         std::optional<double> limit, const Overrides& change) {
  LargestStep found{.predicted = {}};
  const scene::Scene scene = source.with(change);
  const simulate::Settings settings = simulate::set_up(scene, registry).settings;
  found.predicted = predicted(scene, registry, limit);
  StepSearch search(source, registry, integrator, change);
  if (found.failure = search.find_reference(); !found.failure.empty()) return found;
  double high = (settings.until - settings.start) / 10, low = high;
  if (search.bounded(high)) return found.h = high, found.at_limit = true, found;
  int halvings = 0;
  while (halvings < shortest && !search.bounded(low /= 2)) ++halvings, high = low;
  if (halvings == shortest) return found;
  for (int i = 0; i < bisections; ++i) {
    const double middle = std::sqrt(low * high);
    (search.bounded(middle) ? low : high) = middle;
  }
  found.h = low;
  return found;
}

}  // namespace trammel::stability
