// What it costs that an integrator comes from a shared library: the same method through the registry, and linked in.
//
//     tools/bench/run plugin_call --benchmark_repetitions=9 --benchmark_enable_random_interleaving
//
// Both repeat the same thousand steps of the free beam with fixed steps; a step calls the method once and the system
// some twenty times.
#include <benchmark/benchmark.h>

#include "beam_scene.hpp"
#include "main.hpp"
#include "plugins/integrators/newmark/newmark.cpp"  // linked in
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

namespace trammel::bench {
namespace {

enum class From { library, program };

void steps(benchmark::State& report, From from) {
  constexpr int repeated_steps = 1000;
  constexpr double h = 1e-6;  // [s]
  plugin::Registry registry;
  const simulate::Setup setup =
      simulate::set_up(BeamScene{.modes = int(report.range(0)), .integrator = "newmark", .step = h}.parse(), registry);
  const std::unique_ptr<Component> own = trammel_declarations()->front().make();
  own->prepare(setup.model->world);
  Integrator& integrator = from == From::library ? *setup.integrator : dynamic_cast<Integrator&>(*own);
  model::AssembledSystem system(setup.model);
  State start, now, next;
  system.initial(start.q, start.v);
  system.move_to(0, start.q, start.v);
  system.accelerate({}, start.a, start.lambda);
  int i = 0;
  const auto step = [&] {
    if (i++ % repeated_steps == 0) {
      now = start;
      integrator.restart(system, now);
    }
    if (!integrator.step(system, now, h, next)) report.SkipWithError("a step was rejected");
    integrator.accept(system, now, next);
    std::swap(now, next);
  };
  while (i < repeated_steps) step();
  for (auto _ : report) step();
}

}  // namespace

void register_all() {
  for (const int modes : {1, 5}) {
    benchmark::RegisterBenchmark("from its library", steps, From::library)->Arg(modes);
    benchmark::RegisterBenchmark("linked in", steps, From::program)->Arg(modes);
  }
}

}  // namespace trammel::bench
