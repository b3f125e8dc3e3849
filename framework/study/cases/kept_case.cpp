#include "study/cases/kept_case.hpp"

#include <limits>
#include <new>

#include <nlohmann/json.hpp>

#include "commands/simulation.hpp"
#include "report/series.hpp"
#include "simulate/start/setup.hpp"
#include "statics/static_run.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;
using Status = CaseResult::Status;

// series.csv has all digits, so that reductions are those of a case in memory.
Series series_of(const std::filesystem::path& folder) {
  const report::Series file = report::read_series(folder / "series.csv", std::numeric_limits<std::size_t>::max());
  Series series;
  series.names.assign(file.names.begin() + 1, file.names.end());
  series.t = file.columns[0];
  for (std::size_t row = 0; row < series.t.size(); ++row)
    for (std::size_t k = 1; k < file.columns.size(); ++k) series.values.push_back(file.columns[k][row]);
  return series;
}

CaseResult::Status status_of(simulate::Status status) {
  switch (status) {
    case simulate::Status::done:
      return Status::done;
    case simulate::Status::interrupted:
      return Status::interrupted;
    case simulate::Status::failed:
      break;
  }
  return Status::failed;
}

CaseCounts counts_of(const json& result) {
  const json& n = result.contains("counts") ? result.at("counts") : result;  // of statics: few, not in a group
  const auto count = [&](const char* name) { return n.value(name, 0LL); };
  CaseCounts all{count("steps"),          count("contact_steps"),        count("rejected"),
                 count("locating_steps"), count("residual_evaluations"), count("jacobian_evaluations"),
                 count("factorizations"), count("newton_iterations"),    count("events"),
                 count("impacts")};
  if (result.contains("load_steps")) all.steps = (long long)(result.at("load_steps").size());
  return all;
}

void run(CaseResult& result, const scene::Scene& scene, plugin::Registry& registry, const std::filesystem::path& folder,
         const CaseOptions& options) {
  simulate::RunOptions run_options;
  run_options.out = folder;
  run_options.interrupt = options.interrupt, run_options.witness = options.witness;
  const bool statics = simulate::purpose_of(scene.root()) == simulate::Purpose::statics;
  const simulate::RunReport report =
      statics ? run_static(scene, registry, run_options) : simulate::run(scene, registry, run_options);
  const json all = json::parse(report.result_json);
  result.status = status_of(report.status), result.reason = report.reason;
  result.counts = counts_of(all);
  result.t_end = all.at("t_end"), result.cpu = all.at("cpu_time_s");
  result.warnings = all.at("warnings").get<std::vector<std::string>>();
  if (!statics) result.integrator = all.at("integrator"), result.energy_drift = all.at("energy_drift");
  if (result.done()) result.series = series_of(folder);  // a failed case on a full disk may have none
}

}  // namespace

CaseResult run_kept_case(const scene::Scene& scene, plugin::Registry& registry, const std::filesystem::path& folder,
                         const CaseOptions& options) {
  CaseResult result;
  result.scene_hash = scene.hash();
  const auto ended = [&](Status status, const char* reason) { result.status = status, result.reason = reason; };
  std::error_code error;
  try {
    run(result, scene, registry, folder, options);
  } catch (const std::bad_alloc&) {
    ended(Status::failed, "out of memory");
  } catch (const std::exception& e) {
    ended(std::filesystem::exists(folder / "result.json", error) ? Status::failed : Status::refused, e.what());
  }
  if (result.status == Status::refused) std::filesystem::remove(folder, error);  // only if it is empty
  return result;
}

}  // namespace trammel::study
