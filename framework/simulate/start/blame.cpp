#include "simulate/start/blame.hpp"

#include <exception>
#include <new>

#include <fmt/format.h>

#include "run/run_failed.hpp"
#include "simulate/results/log_file.hpp"

namespace trammel::simulate {
namespace {

std::string what_was_thrown() {
  try {
    throw;
  } catch (const std::exception& e) {
    return fmt::format("it threw: {}", e.what());
  } catch (...) {
    return "it threw something that is no std::exception";
  }
}

}  // namespace

std::string said(const OutsideDomain& outside, const model::CallSite& site) {
  return site.origin ? fmt::format("{}: {}", site.origin->path, outside.what()) : std::string(outside.what());
}

scene::Problem problem_of(const OutsideDomain& outside, const model::CallSite& site, const scene::Value& root,
                          double t) {
  const scene::Value* at = site.origin ? root.at_path(site.origin->path) : nullptr;
  return (at ? *at : root).problem(fmt::format("at t = {:.9g} s {}", t, outside.what()));
}

plugin::PluginError blame(const Setup& setup, const model::CallSite& site, double t, std::optional<long long> step) {
  const std::string cause = what_was_thrown();
  const plugin::PluginError error(site.origin ? *site.origin : setup.integrator_origin,
                                  site.origin ? site.call : "step", cause, t);
  return step ? error.in_step(*step) : error;
}

// The component is unknown: a check after each call would cost as much as the cheapest calls.
void require_arithmetic(plugin::ProcessSettings& settings, const Setup& setup, double t, long long step) {
  const std::string fault = plugin::arithmetic_fault();
  if (fault.empty()) return;
  settings.put_back();
  const std::string cause = fault + ": it changed the arithmetic of the process, or a component that was called did";
  const bool has_integrator = !setup.integrator_origin.file.empty();
  const plugin::Origin origin = has_integrator ? setup.integrator_origin : plugin::Origin{"of this scene", "", ""};
  throw plugin::PluginError(origin, has_integrator ? "step" : "a load step", cause, t).in_step(step);
}

void rethrow_blamed(const Setup& setup, const model::CallSite& site, const scene::Value& root, double t) {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const BadStep& e) {
    throw plugin::PluginError(setup.integrator_origin, "step", e.what(), t);
  } catch (const RunFailed&) {
    throw;
  } catch (const OutputError&) {
    throw;
  } catch (const scene::SceneError&) {
    throw;
  } catch (const plugin::PluginError&) {
    throw;
  } catch (const plugin::PassesThroughPlugins&) {
    throw;
  } catch (const OutsideDomain& e) {
    throw scene::SceneError({problem_of(e, site, root, t)});
  } catch (...) {
    if (!site.origin && setup.integrator_origin.file.empty()) throw;  // statics: no other component can be meant
    throw blame(setup, site, t, std::nullopt);
  }
}

}  // namespace trammel::simulate
