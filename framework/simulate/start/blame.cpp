#include "simulate/start/blame.hpp"

#include <exception>
#include <new>
#include <string_view>

#include <fmt/format.h>

#include "simulate/results/log_file.hpp"
#include "run/run_failed.hpp"

namespace trammel::simulate {
namespace {

// The path in the scene of a component of this name, of the kind that `call` belongs to.
struct Place {
  const char* group;
  Kind kind;
};

Place place_of(std::string_view call) {
  if (call == "rows" || call == "slip_row" || call == "bearings") return {"joints", Kind::joint};
  if (call == "wrench" || call == "potential") return {"forces", Kind::force};
  if (call == "normal") return {"contacts", Kind::contact};
  return {"bodies", Kind::body};
}

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

namespace {

std::string path_of(const model::CallSite& site) {
  return fmt::format("{}.{}", place_of(site.call).group, *site.component);
}

}  // namespace

std::string said(const OutsideDomain& outside, const model::CallSite& site) {
  return site.component ? fmt::format("{}: {}", path_of(site), outside.what()) : std::string(outside.what());
}

scene::Problem problem_of(const OutsideDomain& outside, const model::CallSite& site, const scene::Value& root,
                          double t) {
  const scene::Value* at = site.component ? root.at_path(path_of(site)) : nullptr;
  return (at ? *at : root).problem(fmt::format("at t = {:.9g} s {}", t, outside.what()));
}

plugin::Origin origin_of(const model::CallSite& site, const scene::Value& root, plugin::Registry& registry) {
  const Place place = place_of(site.call);
  const std::string path = path_of(site);
  if (const scene::Value* object = root.at_path(path))
    if (const scene::Value* type = object->find("type")) {
      scene::Problems ignored;
      if (const plugin::Entry* entry = registry.find(place.kind, *type, ignored)) return entry->origin(path);
    }
  return {"", to_string(place.kind), path};
}

plugin::PluginError blame(const Setup& setup, const model::CallSite& site, const scene::Value& root,
                          plugin::Registry& registry, double t, std::optional<long long> step) {
  const std::string cause = what_was_thrown();
  const plugin::PluginError error = site.component
                                        ? plugin::PluginError(origin_of(site, root, registry), site.call, cause, t)
                                        : plugin::PluginError(setup.integrator_origin, "step", cause, t);
  return step ? error.in_step(*step) : error;
}

// The component is not known: a check after each call would cost as much as the cheapest calls.
void require_arithmetic(plugin::ProcessSettings& settings, const Setup& setup, double t, long long step) {
  const std::string fault = plugin::arithmetic_fault();
  if (fault.empty()) return;
  settings.put_back();
  const std::string cause = fault + ": it changed the arithmetic of the process, or a component that was called did";
  const bool has_integrator = !setup.integrator_origin.file.empty();
  const plugin::Origin origin = has_integrator ? setup.integrator_origin : plugin::Origin{"of this scene", "", ""};
  throw plugin::PluginError(origin, has_integrator ? "step" : "a load step", cause, t).in_step(step);
}

void rethrow_blamed(const Setup& setup, const model::CallSite& site, const scene::Value& root,
                    plugin::Registry& registry, double t) {
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
    if (!site.component && setup.integrator_origin.file.empty()) throw;  // statics: nobody else can be meant
    throw blame(setup, site, root, registry, t, std::nullopt);
  }
}

}  // namespace trammel::simulate
