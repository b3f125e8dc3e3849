// One run of a scene in memory and in this process: no results folder, no checkpoints.
//
//     const SceneSource source("pendulum.json");
//     const CaseResult r = run_case(source.with({{"bodies.bob.mass", "2"}}), registry);
//     r.series.at(r.series.rows() - 1, *r.series.column("theta"))
//
// A run that fails is a result like others: nothing is thrown for it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <trammel/integrator.hpp>

#include "plugin/registry.hpp"
#include "run/interrupt.hpp"
#include "scene/value.hpp"
#include "simulate/start/crash_witness.hpp"
#include "study/cases/series.hpp"

namespace trammel::study {

struct CaseOptions {
  double cpu_limit = std::numeric_limits<double>::infinity();  // [s] of the simulation; a longer run is `too_long`
  SeriesSink::Keep keep = SeriesSink::Keep::observed;
  // v is moved along the acceleration at the start, which rows at rest allow, by this part of the largest speed at the
  // start, or of the speed that this acceleration gives over the run.
  double perturbation = 0;
  std::optional<State> start;    // starts here, as if the run had reached this state
  std::optional<double> enough;  // [s] a run is done as soon as it passes this time
  simulate::Interrupt* interrupt = nullptr;
  simulate::CrashWitness* witness = nullptr;
};

// Work that does not depend on the machine.
struct CaseCounts {
  long long steps = 0, contact_steps = 0, rejected = 0, locating_steps = 0;
  long long evaluations = 0, jacobians = 0, factorizations = 0, newton_iterations = 0;  // system/assembled_system.hpp
  long long events = 0, impacts = 0;
};

struct CaseResult {
  enum class Status {
    done,
    failed,    // the run ended before its time: `reason`
    refused,   // the scene or a plugin is wrong
    too_long,  // than CaseOptions::cpu_limit
    interrupted
  };
  Status status = Status::refused;
  std::string reason;
  std::uint64_t scene_hash = 0;
  std::string integrator;  // type
  Series series;           // up to the time that the run reached
  std::vector<simulate::ContactEvent> events;
  CaseCounts counts;
  double t_end = 0;                           // [s] reached
  double cpu = 0, cpu_set_up = 0;             // [s] of the simulation; of set-up
  double energy_start = 0, energy_drift = 0;  // [J] energy_drift: what no cause explains (ledger.hpp)
  double relative_drift = 0;                  // of a finished run: Simulator::relative_drift
  double dissipated = 0;                      // [J] by named causes
  std::vector<std::string> warnings;

  bool done() const { return status == Status::done; }
};
const char* to_string(CaseResult::Status status);

// A scene of statics gives its equilibria, one per row.
CaseResult run_case(const scene::Scene& scene, plugin::Registry& registry, const CaseOptions& options = {});

double thread_cpu_now();  // [s]

}  // namespace trammel::study
