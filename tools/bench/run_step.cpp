// What one step of a whole run costs: the method's step, the search for events, the energy ledger, a record every 1 ms.
//
//     tools/bench/run run_step
//
// The beam swings from 45 degrees by HHT-alpha in steps of 1e-6 s. "no contact": a scene without contacts. "plane far
// below": with one that never closes, so that the difference is what looking for contact costs. Columns: modes.
#include <vector>

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "allocations.hpp"
#include "beam_scene.hpp"
#include "main.hpp"
#include "records_folder.hpp"
#include "simulate/start/setup.hpp"
#include "simulate/simulator.hpp"

namespace trammel::bench {
namespace {

struct Case {
  const char* coupling;
  bool plane;
};

void steps(benchmark::State& report, const Case& c) {
  BeamScene scene{.modes = int(report.range(0)), .coupling = c.coupling};
  scene.angle = EIGEN_PI / 4;
  if (c.plane) scene.plane = -10;
  plugin::Registry registry;
  const simulate::Setup setup = simulate::set_up(scene.parse(), registry);
  const RecordsFolder folder;
  simulate::Recorder recorder(folder.path, *setup.model, setup.columns, {});
  simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
  simulator.start(setup.initial);
  for (int i = 0; i < 2500; ++i) simulator.advance(recorder);  // scratch vectors get their sizes
  const long long allocated = allocations();
  for (auto _ : report) simulator.advance(recorder);
  report.counters["allocations"] = double(allocations() - allocated) / double(report.iterations());
}

const std::vector<Case> cases = {{"full", false}, {"full", true}, {"linear", false}, {"none", false}, {"none", true}};

}  // namespace

void register_all() {
  for (const Case& c : cases) {
    const std::string name = fmt::format("{}, {}", c.coupling, c.plane ? "plane far below" : "no contact");
    auto* b = benchmark::RegisterBenchmark(name.c_str(), [&c](benchmark::State& report) { steps(report, c); });
    for (const int modes : {3, 5, 7, 9, 15, 20, 30}) b->Arg(modes);
  }
}

}  // namespace trammel::bench
