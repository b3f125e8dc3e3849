// Energy, rows, stability, error estimates and dense output of integrators.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "testing/kit/integrators/integrators.hpp"
#include "testing/kit/integrators/order.hpp"

namespace trammel::kit {

double steps_per_radian(int order) {
  // Steps are long enough for errors above round-off, and short enough for the next term to be a few hundredths.
  if (order <= 2) return 1 / 0.02;
  if (order <= 4) return 1 / 0.04;
  return order == 5 ? 1 / 0.06 : 1 / 0.2;
}

Report energy_error_shrinks(const Subject& s) {
  const Problem problem = some_pendulum(s);
  Report report;
  claim_shrinks(
      report,
      converge("the largest change of the pendulum's energy", problem.until, step_numbers(4, 4096, s.traits().order),
               [&](int n) { return energy_drift(s.maker<Integrator>(), problem, n); }),
      s.traits().order);
  return report;
}

Report holds_its_rows(const Subject& s, const Problem& problem) {
  const Traits traits = s.traits();
  const Maker make = s.maker<Integrator>();
  Report report;
  const ConstraintDrift drift = constraint_drift(make, problem, 128);
  // What is claimed to hold holds to the tolerance of an iteration, 1e-10 or better in units of the problem.
  if (traits.holds_position)
    report.claim("g = 0 within 1e-9 after each step", drift.position <= 1e-9,
                 fmt::format("found {:.3e}", drift.position));
  if (traits.holds_velocity)
    report.claim("G v + g_t = 0 within 1e-9 after each step", drift.velocity <= 1e-9,
                 fmt::format("found {:.3e}", drift.velocity));
  if (traits.holds_position && traits.holds_velocity) return report;
  const auto larger = [&](int n) {
    const ConstraintDrift d = constraint_drift(make, problem, n);
    return std::max(traits.holds_position ? 0 : d.position, traits.holds_velocity ? 0 : d.velocity);
  };
  claim_shrinks(report, converge("what the rows are off", problem.until, step_numbers(8, 4096, traits.order), larger),
                traits.order);
  return report;
}

Report is_stable_for_small_steps(const Subject& s) {
  const int order = s.traits().order;
  Report report;
  for (const double Omega : {0.02, 0.05, 0.1, 0.2}) {
    const double radius = amplification(s.maker<Integrator>(), Omega).radius;
    // The principal roots are exp(i Omega) up to the local error; any other root must be smaller than 1. The roots are
    // found from trajectories to 1e-6.
    const double allowed = 1 + 1e-6 + 10 * std::pow(Omega, order + 1);
    report.claim(fmt::format("spectral radius at most {:.9f} at omega h = {}", allowed, Omega), radius <= allowed,
                 fmt::format("found {:.9f}", radius));
  }
  return report;
}

// A step that is too long for the method may be rejected, as by sweeps that do not converge.
Report estimates_its_error(const Subject& s, const Problem& problem, double omega, double step) {
  for (int halvings = 0; halvings < 4; ++halvings, step /= 2) try {
      return check_estimate(s.maker<Integrator>(), problem, omega, step);
    } catch (const std::runtime_error& e) {
      if (std::string(e.what()).find("was rejected") == std::string::npos) throw;
    }
  return check_estimate(s.maker<Integrator>(), problem, omega, step);
}

namespace {

constexpr double thetas[] = {0.2, 0.5, 0.7};

// The largest error inside the steps of a run.
double error_inside(const Subject& s, const Problem& problem, int n) {
  const auto method = s.maker<Integrator>()();
  auto& dense = dynamic_cast<DenseOutput&>(*method);
  const auto system = problem.system();
  State now = problem.solution(0), next, at;
  method->restart(*system, now);
  double largest = 0;
  for (int i = 0; i < n; ++i) {
    if (!method->step(*system, now, problem.until / n, next)) throw std::runtime_error("a step was rejected");
    for (const double theta : thetas) {
      dense.interpolate(*system, now, next, theta, at);
      const State exact = problem.solution(at.t);
      largest = std::max(largest, std::hypot((at.q - exact.q).norm(), (at.v - exact.v).norm()));
    }
    method->accept(*system, now, next);
    std::swap(now, next);
  }
  return largest;
}

// A step of 50 ms of the pendulum, looked into.
struct Step {
  Problem problem;
  std::unique_ptr<System> system;
  std::unique_ptr<Integrator> method;
  DenseOutput& dense;
  State now, next;
  bool accepted;

  explicit Step(const Subject& s)
      : problem(any_pendulum(s)),
        system(problem.system()),
        method(s.maker<Integrator>()()),
        dense(dynamic_cast<DenseOutput&>(*method)),
        now(problem.solution(0)) {
    method->restart(*system, now);
    accepted = bool(method->step(*system, now, 0.05, next));
  }
  State inside(double theta) {
    State at;
    dense.interpolate(*system, now, next, theta, at);
    return at;
  }
};

}  // namespace

Report dense_output_has_an_order(const Subject& s) {
  const Problem problem = some_oscillator(s);
  Report report;
  // Cubic interpolation of positions is the least that a located event needs; of lower order no method can do better.
  claim_shrinks(report,
                converge("the error inside the steps", problem.until, step_numbers(4, 1024, s.traits().order),
                         [&](int n) { return error_inside(s, problem, n); }),
                std::min(s.traits().order, 3));
  return report;
}

Report dense_output_meets_the_ends(const Subject& s) {
  Step step(s);
  Report report;
  report.claim("a step of 50 ms is accepted", step.accepted);
  if (!step.accepted) return report;
  const State start = step.inside(0), end = step.inside(1);
  const double off = std::max(std::hypot((start.q - step.now.q).norm(), (start.v - step.now.v).norm()),
                              std::hypot((end.q - step.next.q).norm(), (end.v - step.next.v).norm()));
  // Some roundings of sums of numbers about 1.
  report.claim("theta = 0 and 1 give the ends of the step", off <= 1e-14, fmt::format("{:.3e} off", off));
  report.claim("t = now.t + theta h", std::abs(step.inside(0.25).t - (step.now.t + 0.0125)) <= 1e-15);
  return report;
}

Report dense_output_is_that_of_the_step(const Subject& s) {
  Step step(s);
  Report report;
  report.claim("a step of 50 ms is accepted", step.accepted);
  if (!step.accepted) return report;
  const State before = step.inside(0.4);
  State other;
  const bool tried = bool(step.method->step(*step.system, step.now, 0.01, other));
  step.method->accept(*step.system, step.now, step.next);
  const State after = step.inside(0.4);
  report.claim("the state inside a step is the same after another trial and after it was accepted",
               tried && same_bits(before.q, after.q) && same_bits(before.v, after.v));
  return report;
}

}  // namespace trammel::kit
