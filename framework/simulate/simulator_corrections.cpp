// Corrections of the state at the end of a step, and what they may change.
#include <string>
#include <utility>

#include <fmt/format.h>

#include "plugin/breadcrumb.hpp"
#include "plugin/guard.hpp"
#include "simulate/simulator.hpp"

namespace trammel::simulate {
namespace {

// What a correction has changed without the right to at the end of a step; "" if nothing.
std::string wrongly_changed(const State& uncorrected, const State& corrected) {
  for (const auto& [name, member] : {std::pair("q", &State::q), std::pair("v", &State::v), std::pair("a", &State::a),
                                     std::pair("lambda", &State::lambda)})
    if (const auto n = (uncorrected.*member).size(), found = (corrected.*member).size(); found != n)
      return fmt::format("it left {} with {} numbers; expected {}", name, found, n);
  if (!corrected.q.allFinite() || !corrected.v.allFinite()) return "it left numbers that are not finite";
  if (corrected.t != uncorrected.t)
    return fmt::format("it changed the time to {:.9g} s; expected {:.9g} s", corrected.t, uncorrected.t);
  return "";
}

}  // namespace

// Exceptions and wrong changes are charged to the correction unless a component that it called through the system
// threw.
Outcome Simulator::corrected(const LevelCorrection& entry, const Correction::Step& step) {
  const plugin::Breadcrumb goes_on(*entry.origin, "apply");
  plugin::ProcessSettings settings;
  const Outcome outcome = [&] {
    try {
      return entry.correction->apply(entry.level, system_, step, next_);
    } catch (...) {
      if (system_.last_call().origin) throw;
      plugin::rethrow_as_plugin_error(*entry.origin, "apply", next_.t);
    }
  }();
  const char* const fault = plugin::arithmetic_fault();
  settings.put_back();
  std::string cause = wrongly_changed(step.uncorrected, next_);
  if (*fault)
    cause = fmt::format("{}: it changed the arithmetic of the process, or a component that was called did", fault);
  if (!cause.empty()) throw plugin::PluginError(*entry.origin, "apply", cause, step.uncorrected.t);
  return outcome;
}

// The ledger follows the method's own step: energy changed by a correction counts as supplied by nothing.
void Simulator::step_ledger_and_correct() {
  ledger_.step(now_, next_);
  uncorrected_ = next_;
  const Correction::Step step{now_, uncorrected_, ledger_.energy()};
  for (const LevelCorrection& entry : corrections_)
    if (const Outcome outcome = corrected(entry, step); !outcome) fail(next_.t - now_.t, outcome.reason());
  if (next_.q == uncorrected_.q && next_.v == uncorrected_.v) return;
  system_.move_to(next_.t, next_.q, next_.v);
  system_.accelerate({}, next_.a, next_.lambda);
  ledger_.restart(next_);
}

}  // namespace trammel::simulate
