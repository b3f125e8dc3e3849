#include "simulate/event/trial_step.hpp"

#include <cmath>

#include <fmt/format.h>

#include "run/run_failed.hpp"

namespace trammel::simulate {

Outcome trial_step(Integrator& integrator, System& system, const State& now, double h, State& next) {
  const Outcome outcome = integrator.step(system, now, h, next);
  if (!outcome) return outcome;
  const Sizes n = system.sizes();
  const auto require = [](const char* what, const Vec& x, Eigen::Index expected) {
    if (x.size() != expected)
      throw BadStep(fmt::format("it returned {} with {} entries; expected {}", what, x.size(), expected));
  };
  require("q", next.q, n.nq), require("v", next.v, n.nv), require("a", next.a, n.nv);
  require("lambda", next.lambda, n.nc);
  return outcome;
}

std::string not_finite_in(const State& next) {
  for (const auto& [name, x] : {std::pair{"q", &next.q}, {"v", &next.v}, {"a", &next.a}})
    for (Eigen::Index i = 0; i < x->size(); ++i)
      if (!std::isfinite((*x)[i])) return fmt::format("{}[{}] = {}", name, i, (*x)[i]);
  return "";
}

bool finite_with_shorter_steps(Integrator& integrator, System& system, const State& now, double h, State& scratch) {
  for (const int halvings : {10, 20, 30})
    if (!trial_step(integrator, system, now, std::ldexp(h, -halvings), scratch) || not_finite_in(scratch).empty())
      return true;
  return false;
}

}  // namespace trammel::simulate
