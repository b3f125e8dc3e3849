// How well rows hold after steps: |g| and |G v + g_t|.
#include <fmt/format.h>

#include <trammel/testing/measurements.hpp>

namespace trammel {
namespace {

void keep_largest(double& largest, double x) {
  if (!(x <= largest)) largest = x;  // NaN stays
}

}  // namespace

ConstraintDrift constraint_drift(const Maker& make, const Problem& problem, int n) {
  const auto method = make();
  const auto system = problem.system(), probe = problem.system();
  ConstraintDrift drift;
  integrate(*method, *system, problem.solution(0), problem.until, n, [&](const State& s) {
    probe->move_to(s.t, s.q, s.v);
    keep_largest(drift.position, probe->g().norm());
    keep_largest(drift.velocity, probe->g_dot().norm());
  });
  return drift;
}

Report check_constraints(const Maker& make, const Problem& problem, int n, double allowed) {
  const ConstraintDrift drift = constraint_drift(make, problem, n);
  const Traits traits = make()->traits();
  // Rows that are held are held to the tolerance of an iteration, 1e-10 or better in units of the problem.
  const double position = traits.holds_position ? 1e-9 : allowed, velocity = traits.holds_velocity ? 1e-9 : allowed;
  Report report;
  report.claim(fmt::format("g of {} within {}", problem.name, position), drift.position <= position,
               fmt::format("found {:.3e}", drift.position));
  report.claim(fmt::format("G v + g_t of {} within {}", problem.name, velocity), drift.velocity <= velocity,
               fmt::format("found {:.3e}", drift.velocity));
  return report;
}

}  // namespace trammel
