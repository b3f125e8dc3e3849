// What the boundary of a plugin costs: a step of newmark from its shared library, and the same source compiled into
// this program.
//
//     tools/bench/run plugin_step --benchmark_enable_random_interleaving=true --benchmark_repetitions=20
//
// Both advance the beam of scenes/beam_impact.json, in free flight, by the same steps through the same System.
#include <memory>

#include <benchmark/benchmark.h>

#include "beam_scene.hpp"
#include "main.hpp"
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

#include <trammel/plugin.hpp>

extern "C" const trammel::Declarations* trammel_declarations();  // of plugins/integrators/newmark, in this program

namespace trammel::bench {
namespace {

constexpr double h = 1e-6;  // [s]
constexpr int repeated_steps = 1000;

std::unique_ptr<Integrator> linked() {
  std::unique_ptr<Component> component = trammel_declarations()->front().make();
  auto* const integrator = dynamic_cast<Integrator*>(component.release());
  integrator->prepare({});
  return std::unique_ptr<Integrator>(integrator);
}

void steps(benchmark::State& report, bool from_plugin) {
  plugin::Registry registry;
  const BeamScene scene{.modes = int(report.range(0)), .integrator = "newmark", .step = h, .angular_velocity = -4.546};
  simulate::Setup setup = simulate::set_up(scene.parse(), registry);
  const std::unique_ptr<Integrator> own = from_plugin ? nullptr : linked();
  Integrator& integrator = from_plugin ? *setup.integrator : *own;
  model::AssembledSystem system(setup.model);
  State start, now, next;
  system.initial(start.q, start.v);
  system.move_to(0, start.q, start.v);
  system.accelerate({}, start.a, start.lambda);
  const auto step = [&](int i) {
    if (i % repeated_steps == 0) {
      now = start;
      integrator.restart(system, now);
    }
    if (!integrator.step(system, now, h, next)) return false;
    integrator.accept(system, now, next);
    std::swap(now, next);
    return true;
  };
  int i = 0;
  for (; i < repeated_steps; ++i)  // scratch vectors get their sizes
    if (!step(i)) return report.SkipWithError("a step was rejected");
  for (auto _ : report) step(i++);
}

}  // namespace

void register_all() {
  for (const bool from_plugin : {true, false})
    benchmark::RegisterBenchmark(from_plugin ? "plugin" : "linked",
                                 [=](benchmark::State& report) { steps(report, from_plugin); })
        ->Arg(3)
        ->Arg(9);
}

}  // namespace trammel::bench
