// Finds the plugin from which an exception came.
#pragma once

#include <optional>
#include <string>

#include <trammel/outside_domain.hpp>

#include "plugin/process/settings.hpp"
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// To be called in a catch block; see `blaming`.
[[noreturn]] void rethrow_blamed(const Setup& setup, const model::CallSite& site, const scene::Value& root, double t);

// To be called in a catch block: the exception as the fault of the component that was being called, or of the
// integrator if there was none. `steps` is empty outside a run.
plugin::PluginError blame(const Setup& setup, const model::CallSite& site, double t, std::optional<long long> step);

// Calls a function. Exceptions of the framework pass, among them named errors of scenes and plugins; all others are
// blamed on a component. For calls into a model before its run.
template <class Call>
void blaming(const Setup& setup, const model::AssembledSystem& system, const scene::Value& root, double t, Call call) {
  try {
    call();
  } catch (...) {
    rethrow_blamed(setup, system.last_call(), root, t);
  }
}

// To be called in a catch block of OutsideDomain: its message with the component that was being called. `said` gives
// the text alone: "forces.s: its ...".
std::string said(const OutsideDomain& outside, const model::CallSite& site);
scene::Problem problem_of(const OutsideDomain& outside, const model::CallSite& site, const scene::Value& root,
                          double t);
// Throws PluginError if a component has changed the arithmetic settings of the process, which would make numbers wrong,
// and restores them.
void require_arithmetic(plugin::ProcessSettings& settings, const Setup& setup, double t, long long step);

}  // namespace trammel::simulate
