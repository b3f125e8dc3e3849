// Trusses of n units: one evaluation of the accelerations, and one corrected step of RK4 (four evaluations, positions
// and velocities).
//
//     tools/bench/run truss_step
//
// Scissor mast, prismatic mast and hoop of scenes/truss, n = 100 to 10,000. "growth" is p of time ~ n^p. Setting up a
// scene is not counted; its seconds are a counter of its own.
#include <chrono>
#include <string>

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "main.hpp"
#include "records_folder.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/setup.hpp"

namespace trammel::bench {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

simulate::Setup set_up(const std::string& name, benchmark::State& report, plugin::Registry& registry) {
  const double begin = seconds();
  simulate::Setup setup = simulate::set_up(
      scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/truss/" + name + ".json",
                         {{"parameters.n", std::to_string(report.range(0))}, {"corrections.energy", "false"}}),
      registry);
  report.counters["set_up_s"] = seconds() - begin;
  report.SetComplexityN(report.range(0));
  return setup;
}

void evaluation(benchmark::State& report, const std::string& name) {
  plugin::Registry registry;
  const simulate::Setup setup = set_up(name, report, registry);
  model::AssembledSystem system(setup.model);
  const Vec beside = setup.initial.v + Vec::Constant(setup.initial.v.size(), 1e-12);
  Vec a, lambda;
  bool there = false;
  system.move_to(0, setup.initial.q, setup.initial.v);
  system.accelerate({}, a, lambda);
  for (auto _ : report) {
    there = !there;
    system.move_to(0, setup.initial.q, there ? beside : setup.initial.v);
    system.accelerate({}, a, lambda);
    benchmark::DoNotOptimize(a.data());
  }
}

void step(benchmark::State& report, const std::string& name) {
  plugin::Registry registry;
  const simulate::Setup setup = set_up(name, report, registry);
  const RecordsFolder folder;
  simulate::Recorder recorder(folder.path, *setup.model, setup.columns, {});
  std::vector<simulate::Simulator::LevelCorrection> corrections;
  for (const auto& c : setup.corrections) corrections.push_back({c.level, c.correction.get(), &c.origin});
  simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, corrections);
  simulator.start(setup.initial);
  // Two steps: the second still takes memory, for factors kept beside those of the first.
  for (int step = 0; step < 2; ++step) simulator.advance(recorder);
  for (auto _ : report) {
    if (simulator.advance(recorder)) continue;
    report.PauseTiming();  // it is over, as runs of short masts soon are
    simulator.start(setup.initial);
    report.ResumeTiming();
  }
}

using Measure = void (*)(benchmark::State&, const std::string&);

}  // namespace

void register_all() {
  for (const char* name : {"S1c", "S2c", "S3c"})
    for (const auto& [what, measure] : {std::pair<const char*, Measure>{"evaluation", evaluation}, {"step", step}})
      benchmark::RegisterBenchmark(fmt::format("{}, {}", what, name).c_str(),
                                   [name, measure](benchmark::State& report) { measure(report, name); })
          ->Arg(100)
          ->Arg(1000)
          ->Arg(10000)
          ->Complexity()
          ->Unit(benchmark::kMillisecond);
}

}  // namespace trammel::bench
