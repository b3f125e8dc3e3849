// Which plugin an exception came from.
#pragma once

#include <optional>
#include <string>

#include <trammel/outside_domain.hpp>

#include "plugin/process_settings.hpp"
#include "simulate/start/setup.hpp"
#include "system/assembled_system.hpp"

namespace trammel::simulate {

// Inside a catch block; see `blaming`.
[[noreturn]] void rethrow_blamed(const Setup& setup, const model::CallSite& site, const scene::Value& root, double t);

// Inside a catch block: what was thrown, as the fault of the component that was being called, or of the integrator if
// none was. Without a step outside a run.
plugin::PluginError blame(const Setup& setup, const model::CallSite& site, double t, std::optional<long long> step);

// Lets the framework's own exceptions pass, among them named errors of scenes and plugins; blames all others.
// For calls into a model that is no run yet.
template <class Call>
void blaming(const Setup& setup, const model::AssembledSystem& system, const scene::Value& root, double t, Call call) {
  try {
    call();
  } catch (...) {
    rethrow_blamed(setup, system.last_call(), root, t);
  }
}

// Inside a catch block of OutsideDomain: its message, charged to the component that was being called. `said` alone:
// "forces.s: its ...".
std::string said(const OutsideDomain& outside, const model::CallSite& site);
scene::Problem problem_of(const OutsideDomain& outside, const model::CallSite& site, const scene::Value& root,
                          double t);
// Throws PluginError if a component has changed the arithmetic settings of the process, and restores them: otherwise
// numbers would be wrong.
void require_arithmetic(plugin::ProcessSettings& settings, const Setup& setup, double t, long long step);

}  // namespace trammel::simulate
