// The field's mechanisms: one evaluation of the accelerations, and whole runs at a tolerance.
//
//     tools/bench/run mechanism
//
// "evaluation": M, f, the joints' rows and the solution at a point that is new each time; of chains some steps into the
// run, in its pose and with its violations of the rows, which decide how they are solved. "run": from the scene's start
// to its end with events, ledger and records, without reading the scene; columns: 10 over the exponent of the
// tolerance, counters: evaluations, steps. "implicit steps": 100 of 1e-3 s of a spatial chain in such a run; counters:
// Newton iterations and tangents a step, and the resident memory's peak so far [MB] (start one row alone for its own:
// --benchmark_filter='implicit.*/640$').
#include <cmath>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "main.hpp"
#include "records_folder.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::bench {
namespace {

scene::Scene load(const std::string& name, const std::vector<scene::Override>& overrides = {}) {
  return scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/benchmarks/" + name + ".json", overrides);
}

State after(int steps, const simulate::Setup& setup) {
  if (steps == 0) return setup.initial;
  const RecordsFolder folder;
  simulate::Recorder recorder(folder.path, *setup.model, setup.columns, {});
  simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
  simulator.start(setup.initial);
  while (simulator.statistics().steps < steps && simulator.advance(recorder))
    ;
  return simulator.state();
}

void evaluations(benchmark::State& report, const scene::Scene& scene, int steps = 0) {
  plugin::Registry registry;
  const simulate::Setup setup = simulate::set_up(scene, registry);
  const State state = after(steps, setup);
  model::AssembledSystem system(setup.model);
  const Vec little = Vec::Constant(state.v.size(), 1e-12), v = state.v + little;
  Vec q, a, lambda;
  system.retract(state.q, little, q);
  bool there = false;
  system.move_to(state.t, state.q, v);
  system.accelerate({}, a, lambda);  // lays the factors out
  for (auto _ : report) {
    there = !there;
    system.move_to(state.t, there ? q : state.q, there ? v : state.v);
    system.accelerate({}, a, lambda);
    benchmark::DoNotOptimize(a.data());
  }
}

void whole_run(benchmark::State& report, const std::string& name, const std::string& integrator) {
  plugin::Registry registry;
  const double tolerance = std::pow(10.0, -double(report.range(0)) / 10);
  const scene::Scene scene =
      load(name, {scene::Override{"integrator", fmt::format(fmt::runtime(integrator), tolerance)}});
  double evaluations = 0, steps = 0;
  for (auto _ : report) {
    report.PauseTiming();
    const simulate::Setup setup = simulate::set_up(scene, registry);
    const RecordsFolder folder;
    simulate::Recorder recorder(folder.path, *setup.model, setup.columns, {});
    simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
    report.ResumeTiming();
    simulator.start(setup.initial);
    while (simulator.advance(recorder))
      ;
    evaluations = double(simulator.system().counts().residual_evaluations);
    steps = double(simulator.statistics().steps);
  }
  report.counters["evaluations"] = evaluations;
  report.counters["steps"] = steps;
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
}

void implicit_steps(benchmark::State& report) {
  constexpr int steps = 100;
  plugin::Registry registry;
  const scene::Scene scene = load("chain", {{"parameters.links", std::to_string(report.range(0))},
                                            {"integrator", R"({"type": "hht_alpha", "step": 1e-3})"}});
  model::Counts counts;
  for (auto _ : report) {
    report.PauseTiming();
    const simulate::Setup setup = simulate::set_up(scene, registry);
    const RecordsFolder folder;
    simulate::Recorder recorder(folder.path, *setup.model, setup.columns, {});
    simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
    simulator.start(setup.initial);
    const model::Counts before = simulator.system().counts();
    report.ResumeTiming();
    while (simulator.statistics().steps < steps && simulator.advance(recorder))
      ;
    report.PauseTiming();
    counts = simulator.system().counts();
    counts.newton_iterations -= before.newton_iterations;
    counts.jacobian_evaluations -= before.jacobian_evaluations;
    report.ResumeTiming();
  }
  report.counters["iterations_a_step"] = double(counts.newton_iterations) / steps;
  report.counters["tangents_a_step"] = double(counts.jacobian_evaluations) / steps;
  report.counters["MB"] = peak_memory();
}

}  // namespace

void register_all() {
  for (const char* name : {"andrews", "slider_crank", "a02_n2", "a02_n40", "a04"})
    benchmark::RegisterBenchmark(fmt::format("evaluation, {}", name).c_str(), [name](benchmark::State& report) {
      evaluations(report, load(name));
    })->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark(
      "evaluation, chain",
      [](benchmark::State& report) {
        evaluations(report, load("chain", {{"parameters.links", std::to_string(report.range(0))}}), 20);
      })
      ->RangeMultiplier(10)
      ->Range(10, 10000)
      ->Unit(benchmark::kMicrosecond);
  auto* const implicit = benchmark::RegisterBenchmark("implicit steps, chain", implicit_steps);
  for (const int links : {40, 160, 640, 2560, 10000}) implicit->Arg(links);
  implicit->Unit(benchmark::kMillisecond);
  const auto run = [](const char* title, const char* name, const char* integrator, std::vector<int> exponents) {
    auto* b = benchmark::RegisterBenchmark(
        fmt::format("run, {}", title).c_str(),
        [name, integrator](benchmark::State& report) { whole_run(report, name, integrator); });
    for (const int exponent : exponents) b->Arg(exponent);
    b->Unit(benchmark::kMillisecond);
  };
  run("andrews", "andrews", R"({{"type": "dop853", "step": {{"tolerance": {}, "initial": 1e-5}}}})",
      {40, 45, 50, 55, 60, 90});
  run("a02_n40, projected", "a02_n40", R"({{"type": "dop853", "rows": "projected", "step": {{"tolerance": {}}}}})",
      {30, 60, 90});
}

}  // namespace trammel::bench
