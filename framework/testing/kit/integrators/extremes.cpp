// Integrators at the ends of what a run may ask for: any step, any failure of the system, any scale.
#include <fmt/format.h>

#include <cmath>

#include "testing/kit/allocation_count.hpp"
#include "testing/kit/integrators/integrators.hpp"

namespace trammel::kit {

namespace {

bool finite(const State& s) {
  return s.q.allFinite() && s.v.allFinite() && s.a.allFinite() && s.lambda.allFinite();
}

}  // namespace

Report any_step_is_finite_or_rejected(const Subject& s) {
  Problem problems[] = {any_pendulum(s), problems::stiff_pendulum(1e16), springs({1e-8, 1, 1e8})};
  Report report;
  for (const Problem& problem : problems)
    for (int e = -12; e <= 3; ++e) {
      const auto system = problem.system();
      const auto method = s.maker<Integrator>()();
      State now = problem.solution(0), next;
      method->restart(*system, now);
      for (int i = 0; i < 20; ++i) {  // explicit methods then overflow
        const Outcome outcome = method->step(*system, now, std::pow(10, e), next);
        if (!outcome) {
          if (!*outcome.reason())
            report.claim("a rejection says why", false, fmt::format("not on {}, h = 1e{}", problem.name, e));
          break;
        }
        if (!finite(next)) {
          report.claim("an accepted step is finite", false,
                       fmt::format("step {} of h = 1e{} s on {} gave q = {}, v = {}", i + 1, e, problem.name,
                                   next.q.size() ? next.q[0] : 0, next.v.size() ? next.v[0] : 0));
          return report;
        }
        method->accept(*system, now, next);
        std::swap(now, next);
      }
    }
  report.claim("steps of 1e-12 s to 1e3 s on 3 problems are finite or rejected", report.holds);
  return report;
}

Report rejects_what_is_not_a_number(const Subject& s) {
  bool broken = false;
  const Problem problem =
      particle([&](double, const Vec&, const Vec&) -> Vec { return Vec::Constant(1, broken ? std::nan("") : 1.0); });
  const auto system = problem.system();
  const auto method = s.maker<Integrator>()();
  State now = problem.solution(0), next;
  method->restart(*system, now);
  broken = true;
  const Outcome outcome = method->step(*system, now, 1e-3, next);
  Report report;
  report.claim("a step on a force of NaN is rejected", !outcome,
               outcome ? fmt::format("it was accepted with v = {}", next.v.size() ? next.v[0] : 0) : outcome.reason());
  return report;
}

namespace {

// Three steps with all that may be asked about each, the n-th evaluation failing. False: there are no n of them.
bool run_with_failure(const Subject& s, const Problem& problem, Failing::How how, int n, Report& report) {
  const auto sound = problem.system();
  Failing system(*sound, how);
  const auto method = s.maker<Integrator>()();
  auto* estimate = dynamic_cast<ErrorEstimate*>(method.get());
  auto* dense = dynamic_cast<DenseOutput*>(method.get());
  State now = problem.solution(0), next, inside;
  system.fail_at(n);
  method->restart(system, now);
  for (int i = 0; i < 3; ++i) {
    const State before = now;
    if (!method->step(system, now, 5e-3, next)) {
      const Outcome again = method->step(system, now, 5e-3, next);
      if (!same_bits(before, now)) report.claim("a rejected step leaves `now`", false, fmt::format("failure {}", n));
      // Where a motion could not begin none can go on, nor from an acceleration of 1e200 that was accepted.
      if (!again && (i == 0 || now.a.lpNorm<Eigen::Infinity>() > 1e100)) return true;
      if (!again)
        report.claim("a rejected step can be repeated", false, fmt::format("failure {}: {}", n, again.reason()));
      if (!again) return true;
    }
    if (!finite(next)) report.claim("an accepted step is finite", false, fmt::format("not after failure {}", n));
    if (estimate) estimate->error(system, now, next, {});
    if (dense) dense->interpolate(system, now, next, 0.4, inside);
    method->accept(system, now, next);
    std::swap(now, next);
  }
  return system.has_failed();
}

}  // namespace

Report survives_any_failure(const Subject& s) {
  const Problem problem = any_pendulum(s);
  Report report;
  int evaluations = 0;
  for (const auto how : {Failing::How::beyond_range, Failing::How::not_a_number, Failing::How::singular})
    for (int n = 0; n < 600 && report.holds && run_with_failure(s, problem, how, n, report); ++n) ++evaluations;
  report.claim("three steps in which one evaluation of the system fails are finite or rejected", report.holds,
               fmt::format("{} failures tried", evaluations));
  return report;
}

Report takes_any_mass_ratio(const Subject& s) {
  Report report;
  for (const double ratio : {1.0, 1e4, 1e8}) {
    const Problem problem = problems::dumbbell(ratio);
    const auto method = s.maker<Integrator>()();
    const auto system = problem.system();
    const int n = 256;
    const State end = integrate(*method, *system, problem.solution(0), 0.5, n);
    const State exact = problem.solution(0.5);
    const double off = (end.q - exact.q).norm() / (1 + exact.q.norm());
    // (omega h)^p/p! with omega about 1 rad/s; a light mass must not lose digits of a method of any order.
    const double allowed = std::max(1e-6, 20 * std::pow(4.0 / n, s.traits().order));
    report.claim(fmt::format("a dumbbell of mass ratio {:.0e} turns as it should, within {:.1e}", ratio, allowed),
                 off <= allowed, fmt::format("{:.3e} off after 0.5 s", off));
  }
  return report;
}

Report takes_any_time(const Subject& s) {
  // At 1e9 s the times of a step of 1 ms have six digits left.
  constexpr double later = 1e9;
  const Problem problem = any_pendulum(s), then = shifted(problem, later);
  const auto method = s.maker<Integrator>()();
  const auto system = then.system();
  State now = then.solution(later), next;
  method->restart(*system, now);
  Report report;
  for (int i = 0; i < 50; ++i) {
    const Outcome outcome = method->step(*system, now, 1e-3, next);
    if (!outcome) {
      report.claim("steps of 1 ms at t = 1e9 s are accepted", false, outcome.reason());
      return report;
    }
    method->accept(*system, now, next);
    std::swap(now, next);
  }
  const State exact = problem.solution(0.05);
  const double off = std::hypot((now.q - exact.q).norm(), (now.v - exact.v).norm());
  // Rounding of t by 1e-7 s against rates of up to 10/s.
  const double allowed = std::max(1e-5, 20 * std::pow(1e-3 * pendulum_omega, s.traits().order));
  report.claim(fmt::format("the pendulum at t = 1e9 s moves as at 0, within {:.1e}", allowed), off <= allowed,
               fmt::format("{:.3e} off after 50 steps of 1 ms", off));
  return report;
}

Report allocates_nothing(const Subject& s) {
  Report report;
  const Problem problem = any_pendulum(s);
  const auto system = problem.system();
  const auto method = s.maker<Integrator>()();
  auto* estimate = dynamic_cast<ErrorEstimate*>(method.get());
  if (!count_allocations_of(s.entry.file)) {
    report.claim("allocations cannot be counted on this processor: not asked", true);
    return report;
  }
  State now = problem.solution(0), next;
  method->restart(*system, now);
  long long before = 0;
  for (int i = 0; i < 30; ++i) {
    if (i == 10) before = allocations();
    if (!method->step(*system, now, 5e-3, next)) {
      report.claim("steps of 5 ms are accepted", false);
      return report;
    }
    if (estimate) estimate->error(*system, now, next, {});
    method->accept(*system, now, next);
    std::swap(now, next);
  }
  const long long made = allocations() - before;
  report.claim("20 steps after 10 ask for no memory", made == 0, fmt::format("{} allocations", made));
  return report;
}

}  // namespace trammel::kit
