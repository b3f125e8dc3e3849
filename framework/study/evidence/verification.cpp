#include "study/evidence/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/json_file.hpp"
#include "report/series.hpp"
#include "simulate/results/log_file.hpp"
#include "study/evidence/finer_steps.hpp"
#include "study/trade/errors.hpp"
#include "study/trade/methods.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

constexpr double parted = 0.1;             // relative to a scale: larger differences end the comparison
constexpr double second_tolerance = 1e-8;  // of the other method: tighter than a run usually asks for
constexpr double least_cpu = 0.2;          // [s] of a repetition: cheaper ones need no limit
constexpr double tick = 1e-9;              // [s] the clock's unit: no run counts as cheaper

struct Repeated {
  Repetition as_reported;
  CaseResult result;
  double share = 1;
};

// Methods of error control that share no formula with `type`, of high order first.
std::vector<Method> others(const SceneSource& source, plugin::Registry& registry, const std::string& type) {
  const Methods methods = methods_for(source, registry);
  std::string family;
  for (const Method& m : methods.capable)
    if (m.type == type) family = m.family;
  std::vector<Method> all;
  for (const Method& m : methods.capable)
    if (m.family != family && m.varied == Method::Varied::tolerance) all.push_back(m);
  std::stable_sort(all.begin(), all.end(), [](const Method& a, const Method& b) { return a.order > b.order; });
  return all;
}

class Verifier {
 public:
  Verifier(const SceneSource& source, plugin::Registry& registry, const CaseResult& run, double price)
      : source_(source), registry_(registry), run_(run), left_(std::max(price * run.cpu, least_cpu)) {}

  // True if it reached the end.
  bool repeat(const std::string& what, const Overrides& change, double share) {
    CaseOptions options;
    options.cpu_limit = std::max(left_, 0.0);
    Repeated one{{what, "", 0, 0}, run_case(source_.with(change), registry_, options), share};
    left_ -= one.result.cpu;
    one.as_reported.cpu = one.result.cpu;
    if (one.result.status == CaseResult::Status::too_long)
      one.as_reported.failure = fmt::format("took longer than the price allows, {:.3g} s", options.cpu_limit);
    else if (!one.result.done())
      one.as_reported.failure = one.result.reason;
    repeated_.push_back(std::move(one));
    return repeated_.back().result.done();
  }

  double left() const { return left_; }

  Verification judged(std::optional<double> target) const {
    Verification v;
    v.target = target;
    v.end = run_.series.t.empty() ? 0 : run_.series.t.back();
    v.trusted_until = v.end;
    const scene::Scene scene = source_.with();
    for (const Repeated& r : repeated_)
      if (r.result.done())
        v.trusted_until =
            std::min(v.trusted_until, Measure(r.result, {}, scene).agree_until(run_.series, r.result.series, parted));
    for (const std::string& name : run_.series.names) v.observables.push_back(error_of(name, scene, v.trusted_until));
    for (const Repeated& r : repeated_) {
      v.repetitions.push_back(r.as_reported);
      if (r.result.done())
        v.repetitions.back().difference = Measure(r.result, {}, scene).error(run_.series, v.trusted_until).max;
      v.price += r.as_reported.cpu / std::max(run_.cpu, tick);
    }
    return v;
  }

 private:
  ObservableError error_of(const std::string& name, const scene::Scene& scene, double until) const {
    ObservableError all{
        .name = name, .error = std::nan(""), .scale = 0, .t = 0, .reason = "no repetition came to the end"};
    for (const Repeated& r : repeated_) {
      if (!r.result.done()) continue;
      const Measure measure(r.result, {name}, scene);
      const Error e = measure.error(run_.series, until);
      all.scale = std::max(all.scale, measure.scale(*r.result.series.column(name)));
      const double error = std::max(e.max, e.multipliers) * measure.scale(*r.result.series.column(name)) / r.share;
      if (!(error <= all.error))
        all.error = error, all.t = e.t, all.reason = "differs so much from " + r.as_reported.what;
    }
    return all;
  }

  const SceneSource& source_;
  plugin::Registry& registry_;
  const CaseResult& run_;
  double left_;  // [s] of CPU time
  std::vector<Repeated> repeated_;
};

}  // namespace

bool Verification::met() const {
  return target && trusted_until >= end &&
         std::all_of(observables.begin(), observables.end(),
                     [this](const ObservableError& o) { return o.error <= *target * o.scale; });
}

std::vector<std::string> Verification::sentences() const {
  std::vector<std::string> all;
  const auto came = [](const Repetition& r) { return r.failure.empty(); };
  if (std::none_of(repetitions.begin(), repetitions.end(), came)) {
    all.push_back("not verified: no repetition came to the end");
  } else if (trusted_until < end) {
    all.push_back(
        fmt::format("trust ends at t = {:.6g} s: from there repetitions differ by more than {:g} % of what the "
                    "observables change",
                    trusted_until, 100 * parted));
  }
  if (target)
    all.push_back(met() ? fmt::format("every observable meets the target {:g}", *target)
                        : fmt::format("the target {:g} is not met; trammel trade finds settings that do", *target));
  for (const ObservableError& o : observables)
    if (std::isfinite(o.error))
      all.push_back(fmt::format("{}: error {:.2g} at t = {:.6g} s, {:.2g} of what it changes; {}", o.name, o.error, o.t,
                                o.scale > 0 ? o.error / o.scale : 0, o.reason));
  for (const Repetition& r : repetitions)
    if (!r.failure.empty()) all.push_back(fmt::format("{}: {}", r.what, r.failure));
  return all;
}

json Verification::to_json() const {
  json of_observables = json::object(), of_repetitions = json::array();
  const auto number = [](double x) { return std::isfinite(x) ? json(x) : json(); };
  for (const ObservableError& o : observables)
    of_observables[o.name] = {{"error", number(o.error)}, {"scale", number(o.scale)}, {"t", o.t}, {"reason", o.reason}};
  for (const Repetition& r : repetitions)
    of_repetitions.push_back(
        {{"what", r.what}, {"failure", r.failure}, {"cpu_time", r.cpu}, {"difference", number(r.difference)}});
  json all = {{"trusted_until", trusted_until}, {"price", price}};
  if (target) all["target"] = *target, all["met"] = met();
  all["observables"] = std::move(of_observables), all["repetitions"] = std::move(of_repetitions);
  return all;
}

CaseResult read_run(const std::filesystem::path& folder, const scene::Scene& scene) {
  report::Series read = report::read_series(folder / "series.csv", std::numeric_limits<std::size_t>::max());
  CaseResult run;
  run.status = CaseResult::Status::done;
  run.series.t = std::move(read.columns.front());
  const scene::Value* observed = scene.root().at_path("record.observe");
  std::vector<const std::vector<double>*> kept;
  for (std::size_t i = 1; i < read.names.size(); ++i)
    if (observed && observed->find(read.names[i]))
      run.series.names.push_back(read.names[i]), kept.push_back(&read.columns[i]);
  for (std::size_t row = 0; row < run.series.rows(); ++row)
    for (const auto* column : kept) run.series.values.push_back((*column)[row]);
  run.cpu = report::json_file(folder / "result.json").at("cpu_time_s");
  return run;
}

void record(const Verification& verification, const std::filesystem::path& folder) {
  json result = report::json_file(folder / "result.json");
  result["verification"] = verification.to_json();
  simulate::write_whole(folder / "result.json", result.dump(2) + "\n");
}

Verification verify(const SceneSource& source, plugin::Registry& registry, const CaseResult& run,
                    std::optional<double> target, double price) {
  Verifier verifier(source, registry, run, price);
  const FinerSteps finer = finer_steps(source, registry);
  verifier.repeat(finer.what, finer.change, finer.share);
  for (const Method& m : others(source, registry, finer.type)) {
    if (verifier.left() <= 0) break;
    if (verifier.repeat(fmt::format("{} with tolerance {:g}", m.name, second_tolerance),
                        {{"integrator", m.with_tolerance(second_tolerance)}}, 1))
      break;
  }
  return verifier.judged(target);
}

}  // namespace trammel::study
