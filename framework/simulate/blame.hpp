// Which plugin an exception came from.
#pragma once

#include <exception>
#include <optional>

#include "model/assembled_system.hpp"
#include "plugin/registry.hpp"
#include "simulate/setup.hpp"

namespace trammel::simulate {

// The component that was being called, or the integrator if none was.
plugin::PluginError blame(const std::exception& e, const Setup& setup, const model::CallSite& site,
                          const scene::Value& root, plugin::Registry& registry, double t, long long step);

// Where the component comes from, that was called there.
plugin::Origin origin_of(const model::CallSite& site, const scene::Value& root, plugin::Registry& registry);

}  // namespace trammel::simulate
