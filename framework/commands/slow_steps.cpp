#include "commands/slow_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "diagnose/fastest_motion.hpp"
#include "diagnose/mass_ratio.hpp"

namespace trammel::simulate {
namespace {

constexpr double many = 50;            // steps between two records: fewer are not slow
constexpr double long_wait = 20;       // [s] of CPU time to the end: less is not slow
constexpr double stabilised_at = 10;   // [1/s] Baumgarte's rates of explicit methods by default
constexpr double accounts_for = 0.01;  // radians of the fastest motion: a shorter step has another cause

// Steps of a method of second order that follow an oscillation are about tolerance^(1/3) radians long.
double radians_that_account(bool implicit, const Tolerance& tolerance) {
  return implicit ? std::min(accounts_for, std::cbrt(tolerance.relative) / 2) : accounts_for;
}

std::string cause(const FastestMotion& fastest, const Setup& setup, Simulator& simulator, double h) {
  const bool implicit = setup.integrator->traits().implicit, on_rows = setup.integrator->traits().holds_position;
  const MassRatio ratio = mass_ratio(*setup.model, simulator.state());
  if (ratio.is_large() && !on_rows)
    return fmt::format("{}; \"rows\": \"projected\" in the integrator takes long steps there",
                       description(ratio, *setup.model));
  const bool stabilises = !implicit && !on_rows && simulator.system().sizes().nc > 0;
  if (stabilises && stabilised_at * h > accounts_for && stabilised_at > fastest.rate())
    return fmt::format(
        "rows that are stabilised at {} 1/s bound the steps of an explicit method; \"rows\": \"projected\" in the "
        "integrator takes longer ones",
        stabilised_at);
  const std::string what = description(fastest, *setup.model);
  if (ratio.is_large() && fastest.rate() * h < accounts_for)
    return fmt::format(
        "{}, where round-off leaves few digits of accelerations and the error control follows it; a looser tolerance "
        "does not: \"step\": {{\"tolerance\": {:.0e}}}",
        description(ratio, *setup.model), 1e3 * setup.settings.step.tolerance.relative);
  if (fastest.rate() * h < radians_that_account(implicit, setup.settings.step.tolerance))
    return fmt::format(
        "{}, which asks for none so short, with {} events so far; a looser tolerance takes longer ones, or fixed "
        "steps: \"integrator\": {{\"type\": \"generalized_alpha\", \"step\": {:.0e}}}",
        what, simulator.statistics().events, std::min(setup.settings.every, 1 / fastest.rate()));
  const std::string damper =
      fastest.frequency >= fastest.decay
          ? fmt::format("a damper beside the spring, \"damping\": stiffness / {:.0e}, ends that", fastest.frequency)
          : "";
  if (implicit)
    return fmt::format("{}, by more than the tolerance, and the error control follows it; {}", what,
                       damper.empty() ? "a looser tolerance does not" : damper);
  return fmt::format(
      "{}, and an explicit method follows it; \"integrator\": {{\"type\": \"hht_alpha\", \"step\": "
      "{{\"tolerance\": 1e-5}}}} does not{}",
      what, damper.empty() ? "" : ", unless it swings by more than that tolerance; " + damper);
}

}  // namespace

std::string SlowSteps::look(double seconds, const Setup& setup, Simulator& simulator) {
  if (seconds < next_look_ || setup.settings.step.fixed) return "";
  const double passed = simulator.state().t - t_, left = setup.settings.until - simulator.state().t;
  const double steps = double(simulator.statistics().steps - steps_), took = seconds - last_look_;
  const double wait = passed > 0 ? took * left / passed : std::numeric_limits<double>::infinity();
  t_ = simulator.state().t, steps_ = simulator.statistics().steps;
  last_look_ = seconds, next_look_ = 2 * seconds;
  if (steps * setup.settings.every < many * passed || wait < long_wait) return "";
  next_look_ = std::numeric_limits<double>::infinity();
  const double h = passed / std::max(1.0, steps);
  const std::string slow = fmt::format(
      "t = {:.6g} s: steps of {:.2g} s, {:.3g} of them between two records, leave {:.2g} s of CPU time to go",
      simulator.state().t, h, passed > 0 ? setup.settings.every / h : steps, wait);
  try {
    model::AssembledSystem system(setup.model);
    system.set_modes(simulator.system().modes());
    return slow + ": " + cause(fastest_motion(system, simulator.state()), setup, simulator, h);
  } catch (const std::exception&) {
    return slow;  // a component throws away from the solution
  }
}

}  // namespace trammel::simulate
