#include "study/cases/case_run.hpp"

#include <time.h>

#include <new>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "commands/ending.hpp"
#include "run/run_failed.hpp"
#include "simulate/simulator.hpp"
#include "simulate/start/blame.hpp"
#include "simulate/start/setup.hpp"
#include "statics/load_path.hpp"

namespace trammel::study {
namespace {

using simulate::Purpose;
using Status = CaseResult::Status;

class CaseRun {
 public:
  CaseRun(const scene::Scene& scene, plugin::Registry& registry, const CaseOptions& options, CaseResult& result)
      : scene_(scene), options_(options), result_(result), purpose_(simulate::purpose_of(scene.root())) {
    const double began = thread_cpu_now();
    setup_ = simulate::set_up(scene, registry, purpose_, options.witness);
    result_.cpu_set_up = thread_cpu_now() - began;
    result_.integrator = setup_.integrator_type;
    result_.warnings = setup_.warnings;
  }

  void operator()() {
    SeriesSink sink(setup_.columns, options_.keep);
    began_ = thread_cpu_now();
    purpose_ == Purpose::statics ? load(sink) : simulate(sink);
    result_.cpu = thread_cpu_now() - began_;
    result_.series = std::move(sink.series());
    result_.events = std::move(sink.events());
  }

 private:
  void simulate(SeriesSink& sink) {
    if (options_.start) start_at(*options_.start);
    std::vector<simulate::Simulator::LevelCorrection> corrections;
    for (const auto& c : setup_.corrections) corrections.push_back({c.level, c.correction.get(), &c.origin});
    simulate::Simulator simulator(setup_.model, *setup_.integrator, setup_.settings, std::move(corrections));
    const simulate::WitnessScope scope(options_.witness, setup_, simulator.system(),
                                       {&simulator.state().t, &simulator.statistics().steps});
    try {
      if (options_.perturbation != 0) perturb(simulator.system());
      simulator.start(setup_.initial);
      while (simulator.advance(sink)) {
        require_arithmetic(settings_, setup_, simulator.state().t, simulator.statistics().steps + 1);
        if (stops(simulator.state().t)) break;
        if (options_.enough && simulator.state().t > *options_.enough) break;
      }
      if (result_.status == Status::refused) result_.status = Status::done;
    } catch (...) {
      const double t = simulator.state().t;
      const long long step = simulator.statistics().steps + 1;
      fail({t, step, fmt::format("at t = {:.9g} s, step {}: ", t, step), simulator.system().last_call()});
      if (result_.status == Status::failed) result_.reason += simulator.circumstances();
    }
    collect(simulator);
  }

  void start_at(const State& state) {
    State& initial = setup_.initial;
    if (state.q.size() != initial.q.size() || state.v.size() != initial.v.size())
      throw std::invalid_argument("the state has other coordinates than the scene's start");
    initial = state;
  }

  void perturb(model::AssembledSystem& system) {
    State& start = setup_.initial;
    if (start.v.size() == 0) return;
    Vec a, lambda;
    system.move_to(start.t, start.q, start.v);
    system.accelerate({}, a, lambda);
    const double most = a.lpNorm<Eigen::Infinity>(), speed = start.v.lpNorm<Eigen::Infinity>();
    if (!(most > 0)) return;
    const double by = speed > 0 ? speed : most * (setup_.settings.until - setup_.settings.start);
    start.v += options_.perturbation * by / most * a;
  }

  void load(SeriesSink& sink) {
    model::AssembledSystem system(setup_.model);
    simulate::LoadPath path(system, setup_.settings, setup_.initial);
    try {
      while (!path.at_end() && !stops(path.state().t)) {
        path.advance();
        sink.row(system, path.state(), {}, 0);
      }
      if (result_.status == Status::refused) result_.status = Status::done;
    } catch (...) {
      const double t = path.state().t;
      fail({t, (long long)(path.steps().size()) + 1, fmt::format("after t = {:.9g}: ", t), system.last_call()});
    }
    result_.t_end = path.state().t;
    result_.counts.steps = (long long)(path.steps().size());
    count(system.counts());
  }

  bool stops(double t) {
    if (options_.interrupt && options_.interrupt->heed()) {
      result_.status = Status::interrupted;
      result_.reason = fmt::format("interrupted at t = {:.9g} s", t);
      return true;
    }
    if (++since_clock_ < 16) return false;  // reading the clock takes longer than a short step
    since_clock_ = 0;
    if (thread_cpu_now() - began_ < options_.cpu_limit) return false;
    result_.status = Status::too_long;
    result_.reason = fmt::format("at t = {:.9g} s it had taken more than {:.3g} s", t, options_.cpu_limit);
    return true;
  }

  void fail(const simulate::RunPoint& at) {
    const simulate::Ending e = simulate::ending(setup_, scene_.root(), at);
    result_.status = e.cause == simulate::Ending::Cause::scene ? Status::refused : Status::failed;
    result_.reason = e.reason;
  }

  void count(const model::Counts& c) {
    CaseCounts& n = result_.counts;
    n.evaluations = c.residual_evaluations, n.jacobians = c.jacobian_evaluations;
    n.factorizations = c.factorizations, n.newton_iterations = c.newton_iterations;
  }

  void collect(simulate::Simulator& simulator) {
    count(simulator.system().counts());
    const simulate::Statistics& s = simulator.statistics();
    CaseCounts& n = result_.counts;
    n.steps = s.steps, n.contact_steps = s.contact_steps, n.rejected = s.rejected, n.locating_steps = s.locating_steps;
    n.events = s.events, n.impacts = s.impacts;
    result_.t_end = simulator.state().t;
    result_.energy_start = simulator.ledger().energy_start();
    result_.energy_drift = simulator.last_energy().total() - simulator.ledger().energy();
    if (result_.done()) result_.relative_drift = simulator.relative_drift();
    result_.dissipated = simulator.ledger().dissipated();
    for (const auto& more : {simulator.doubts(), simulator.warnings()})
      result_.warnings.insert(result_.warnings.end(), more.begin(), more.end());
  }

  const scene::Scene& scene_;
  const CaseOptions& options_;
  CaseResult& result_;
  Purpose purpose_;
  plugin::ProcessSettings settings_;
  simulate::Setup setup_;
  double began_ = 0;
  int since_clock_ = 0;
};

}  // namespace

double thread_cpu_now() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

const char* to_string(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::failed:
      return "failed";
    case Status::refused:
      return "refused";
    case Status::too_long:
      return "too_long";
    case Status::interrupted:
      return "interrupted";
  }
  return "";
}

CaseResult run_case(const scene::Scene& scene, plugin::Registry& registry, const CaseOptions& options) {
  CaseResult result;
  result.scene_hash = scene.hash();
  try {
    CaseRun(scene, registry, options, result)();
  } catch (const std::bad_alloc&) {
    result.status = Status::failed, result.reason = "out of memory";
  } catch (const std::exception& e) {  // of set-up: SceneError, PluginError, NotSolvable
    result.status = Status::refused, result.reason = e.what();
  }
  return result;
}

}  // namespace trammel::study
