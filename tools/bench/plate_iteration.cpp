// Clamped plates of n x n elements with a ball above them: one iteration of Newton's method, and one step of the scene.
//
//     tools/bench/run plate_iteration
//
// Iteration: forces, mass times accelerations, tangent, its factors and one solution, 3 x 3 points a cell. The target
// is 2.5 ms with 10 x 10 elements, 5 with 14 x 14, 80 with 40 x 40, and a time that grows no faster than (control
// points)^1.5. "growth" is p of time ~ n^p: 2 where the time is in proportion to the control points, 3 at that bound.
// resident_MB: of this program, at the most so far; set_up_s: scene, mesh and pattern.
#include <chrono>
#include <string>

#include <sys/resource.h>

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

simulate::Setup set_up(benchmark::State& report, plugin::Registry& registry) {
  report.SetComplexityN(report.range(0));
  return simulate::set_up(scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/plate/ball.json",
                                             {{"parameters.mesh", fmt::format("\"{0}x{0}\"", report.range(0))}}),
                          registry);
}

void tell_memory(benchmark::State& report) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  report.counters["resident_MB"] = double(usage.ru_maxrss) / 1024;
}

void iteration(benchmark::State& report) {
  const double begin = seconds();
  plugin::Registry registry;
  const simulate::Setup setup = set_up(report, registry);
  model::AssembledSystem system(setup.model);
  Vec q = setup.initial.q, r = Vec::Zero(setup.initial.v.size()), da, dlambda;
  const Vec a = r, lambda, none;
  const double h = 1e-3;
  const auto iterate = [&] {
    q.head(q.size() - 3).array() += 1e-9;  // all of the plate: another place, no other strains
    system.move_to(0, q, setup.initial.v);
    r = -system.f();
    system.add_mass_times(1, a, r);
    system.factorise({1, 0.5 * h, 0.25 * h * h}, a, lambda);
    if (!system.correct(r, none, da, dlambda)) report.SkipWithError("singular");
  };
  iterate();
  report.counters["set_up_s"] = seconds() - begin;
  for (auto _ : report) iterate();
  tell_memory(report);
}

void step(benchmark::State& report) {
  plugin::Registry registry;
  const simulate::Setup setup = set_up(report, registry);
  const RecordsFolder folder;
  simulate::Recorder recorder(folder.path, *setup.model, setup.columns, {});
  simulate::Simulator simulator(setup.model, *setup.integrator, setup.settings, {});
  simulator.start(setup.initial);
  simulator.advance(recorder);
  for (auto _ : report) simulator.advance(recorder);
  tell_memory(report);
}

using Measure = void (*)(benchmark::State&);

}  // namespace

void register_all() {
  for (const auto& [name, measure] : {std::pair<const char*, Measure>{"iteration", iteration}, {"step", step}})
    benchmark::RegisterBenchmark(name, measure)
        ->Arg(10)
        ->Arg(14)
        ->Arg(20)
        ->Arg(40)
        ->Arg(70)
        ->Arg(100)
        ->Complexity()
        ->Unit(benchmark::kMillisecond);
}

}  // namespace trammel::bench
