// The largest change of the energy of a conservative problem over a run, relative to its scale.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include <trammel/testing/measurements.hpp>

namespace trammel {

double energy_drift(const Maker& make, const Problem& problem, int n) {
  if (!problem.energy.value) throw std::invalid_argument(problem.name + " does not conserve its energy");
  const State start = problem.solution(0);
  const double before = problem.energy.value(start);
  const auto method = make();
  const auto system = problem.system();
  double largest = 0;
  integrate(*method, *system, start, problem.until, n, [&](const State& s) {
    const double change = std::abs(problem.energy.value(s) - before) / problem.energy.scale;
    if (!(change <= largest)) largest = change;  // NaN stays
  });
  return largest;
}

Report check_energy(const Maker& make, const Problem& problem, int n, double allowed) {
  const double found = energy_drift(make, problem, n);
  Report report;
  report.claim(fmt::format("energy of {} within {}", problem.name, allowed), found <= allowed,
               fmt::format("found {:.3e}", found));
  return report;
}

}  // namespace trammel
