// What one step of each method costs on the beam: through the plugins and the assembled system, without events and
// records.
//
//     tools/bench/run integrator_step --benchmark_filter=hht_alpha
//
// Every benchmark repeats the same thousand steps from the same state: the beam straight on the plane just after it
// struck it with e = 0, all modes excited as in a run. "free" steps go on without the contact's row, "closed" ones with
// it; "no contact" is the free beam in a scene without contacts. Rows: method, phase, coupling, step [s]; columns:
// modes.
#include <vector>

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include "allocations.hpp"
#include "beam_scene.hpp"
#include "main.hpp"
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

namespace trammel::bench {
namespace {

enum class Phase { no_contact, free, closed };

struct Case {
  const char* method;
  Phase phase;
  double step;  // [s]
  const char* coupling = "full";
};

constexpr int repeated_steps = 1000;

simulate::Setup set_up(const Case& c, int modes, bool contact, plugin::Registry& registry) {
  BeamScene scene{.modes = modes, .coupling = c.coupling, .integrator = c.method, .step = c.step};
  scene.angular_velocity = -4.546;  // of the first impact
  if (contact) scene.plane = 0;
  return simulate::set_up(scene.parse(), registry);
}

// Just after the impact.
State struck(const Case& c, int modes, plugin::Registry& registry) {
  model::AssembledSystem system(set_up(c, modes, true, registry).model);
  State s;
  system.initial(s.q, s.v);
  system.move_to(0, s.q, s.v);
  Mat jump, delassus;
  system.impulse_response({{0, 0}}, jump, delassus);
  s.v -= jump.col(0) * (system.gap_rate(0) / delassus(0, 0));
  return s;
}

void steps(benchmark::State& report, const Case& c) {
  const int modes = int(report.range(0));
  plugin::Registry registry;
  State start = struck(c, modes, registry);
  const simulate::Setup setup = set_up(c, modes, c.phase != Phase::no_contact, registry);
  Integrator& integrator = *setup.integrator;
  model::AssembledSystem system(setup.model);
  if (c.phase == Phase::closed) {
    model::Modes closed = system.modes();
    closed.contacts[0].closed = true;
    system.set_modes(closed);
  }
  system.move_to(0, start.q, start.v);
  system.accelerate({}, start.a, start.lambda);

  State now = start, next;
  const auto step = [&](int i) {
    if (i % repeated_steps == 0) {
      now = start;
      integrator.restart(system, now);
    }
    if (!integrator.step(system, now, c.step, next)) return false;
    integrator.accept(system, now, next);
    std::swap(now, next);
    return true;
  };
  int i = 0;
  for (; i < repeated_steps; ++i)  // scratch vectors get their sizes
    if (!step(i)) return report.SkipWithError("a step was rejected");
  const model::Counts before = system.counts();
  const long long allocated = allocations();
  for (auto _ : report) step(i++);
  const double n = double(report.iterations());
  report.counters["allocations"] = double(allocations() - allocated) / n;
  report.counters["evaluations"] = double(system.counts().residual_evaluations - before.residual_evaluations) / n;
  report.counters["factorizations"] = double(system.counts().factorizations - before.factorizations) / n;
}

// The paper's steps; explicit methods need the short one everywhere.
const std::vector<Case> cases = {
    {"hht_alpha", Phase::free, 1e-6},
    {"hht_alpha", Phase::free, 1e-4},
    {"hht_alpha", Phase::closed, 1e-6},
    {"hht_alpha", Phase::no_contact, 1e-6},
    {"hht_alpha", Phase::no_contact, 1e-6, "linear"},
    {"hht_alpha", Phase::no_contact, 1e-6, "none"},
    {"newmark", Phase::free, 1e-6},
    {"newmark", Phase::closed, 1e-6},
    {"generalized_alpha", Phase::free, 1e-6},
    {"generalized_alpha", Phase::closed, 1e-6},
    {"adams_baumgarte", Phase::free, 1e-6},
    {"adams_baumgarte", Phase::closed, 1e-6},
    {"adams_baumgarte", Phase::no_contact, 1e-6},
    {"runge_kutta_4", Phase::free, 1e-6},
    {"runge_kutta_4", Phase::closed, 1e-6},
    {"dormand_prince", Phase::free, 1e-6},
    {"dop853", Phase::free, 1e-6},
};

std::string name(const Case& c) {
  const char* phase = c.phase == Phase::closed ? "closed" : c.phase == Phase::free ? "free" : "no contact";
  return fmt::format("{}, {}, {}, {:.0e}", c.method, phase, c.coupling, c.step);
}

}  // namespace

void register_all() {
  for (const Case& c : cases) {
    auto* b = benchmark::RegisterBenchmark(name(c).c_str(), [&c](benchmark::State& report) { steps(report, c); });
    for (const int modes : {3, 5, 7, 9, 15, 20, 30}) b->Arg(modes);
  }
}

}  // namespace trammel::bench
