#include "study/cases/batch.hpp"

#include <numeric>

#include <nlohmann/json.hpp>

#include "study/cases/workers.hpp"

namespace trammel::study {
namespace {

using json = nlohmann::ordered_json;

json counts(const CaseCounts& n) {
  return {n.steps,     n.contact_steps,  n.rejected,          n.locating_steps, n.evaluations,
          n.jacobians, n.factorizations, n.newton_iterations, n.events,         n.impacts};
}

CaseCounts counts(const json& j) {
  CaseCounts n;
  long long* const all[] = {&n.steps,     &n.contact_steps,  &n.rejected,          &n.locating_steps, &n.evaluations,
                            &n.jacobians, &n.factorizations, &n.newton_iterations, &n.events,         &n.impacts};
  for (std::size_t i = 0; i < std::size(all); ++i) *all[i] = j.at(i).get<long long>();
  return n;
}

}  // namespace

std::string packed(const CaseResult& r) {
  json events = json::array();
  for (const simulate::ContactEvent& e : r.events)
    events.push_back({e.t, int(e.kind), e.contact, e.impulse, e.approach, e.separation, e.energy_lost});
  const json all = {
      {"status", int(r.status)},
      {"reason", r.reason},
      {"hash", r.scene_hash},
      {"integrator", r.integrator},
      {"names", r.series.names},
      {"t", r.series.t},
      {"values", r.series.values},
      {"events", events},
      {"counts", counts(r.counts)},
      {"numbers", {r.t_end, r.cpu, r.cpu_set_up, r.energy_start, r.energy_drift, r.relative_drift, r.dissipated}},
      {"warnings", r.warnings}};
  const std::vector<std::uint8_t> bytes = json::to_cbor(all);
  return {bytes.begin(), bytes.end()};
}

CaseResult unpacked(const std::string& bytes) {
  const json all = json::from_cbor(bytes.begin(), bytes.end());
  CaseResult r;
  r.status = CaseResult::Status(all["status"].get<int>()), r.reason = all["reason"];
  r.scene_hash = all["hash"], r.integrator = all["integrator"];
  r.series = {all["names"], all["t"], all["values"]};
  for (const json& e : all["events"]) {
    simulate::ContactEvent event;
    event.t = e[0], event.kind = simulate::ContactEvent::Kind(e[1].get<int>()), event.contact = e[2];
    event.impulse = e[3], event.approach = e[4], event.separation = e[5], event.energy_lost = e[6];
    r.events.push_back(event);
  }
  r.counts = counts(all["counts"]);
  const json& n = all["numbers"];
  r.t_end = n[0], r.cpu = n[1], r.cpu_set_up = n[2], r.energy_start = n[3], r.energy_drift = n[4];
  r.relative_drift = n[5], r.dissipated = n[6];
  r.warnings = all["warnings"].get<std::vector<std::string>>();
  return r;
}

std::vector<CaseResult> Batch::operator()(const std::vector<Overrides>& cases) const {
  std::vector<CaseResult> results(cases.size());
  for (CaseResult& r : results) r.status = CaseResult::Status::interrupted;
  Workers workers;
  workers.jobs = jobs;
  workers.interrupt = options.interrupt;
  workers.work = [&](std::size_t i) {
    try {
      return packed(run_case(source.with(cases[i]), registry, options));
    } catch (const scene::SceneError& e) {
      CaseResult refused;
      refused.reason = e.what();
      return packed(refused);
    }
  };
  const auto keep = [&](std::size_t i, CaseResult result) {
    results[i] = std::move(result);
    if (finished) finished(results[i]);
  };
  workers.answer = [&](std::size_t i, const std::string& bytes) { keep(i, unpacked(bytes)); };
  workers.lost = [&](const Lost& lost) {
    CaseResult failed;
    failed.status = CaseResult::Status::failed, failed.reason = lost.why;
    keep(lost.task, failed);
  };
  std::vector<std::size_t> tasks(cases.size());
  std::iota(tasks.begin(), tasks.end(), 0);
  workers.run(tasks);
  return results;
}

}  // namespace trammel::study
