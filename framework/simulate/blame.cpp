#include "simulate/blame.hpp"

#include <string_view>

#include <fmt/format.h>

namespace trammel::simulate {
namespace {

// Where a component of this name stands in the scene; `call` tells the kind.
struct Place {
  const char* group;
  Kind kind;
};

Place place_of(std::string_view call) {
  if (call == "rows") return {"joints", Kind::joint};
  if (call == "wrench" || call == "potential") return {"forces", Kind::force};
  if (call == "normal") return {"contacts", Kind::contact};
  return {"bodies", Kind::body};
}

}  // namespace

plugin::Origin origin_of(const model::CallSite& site, const scene::Value& root, plugin::Registry& registry) {
  const Place place = place_of(site.call);
  const std::string path = fmt::format("{}.{}", place.group, *site.component);
  if (const scene::Value* object = root.at_path(path))
    if (const scene::Value* type = object->find("type")) {
      scene::Problems ignored;
      if (const plugin::Entry* entry = registry.find(place.kind, *type, ignored)) return entry->origin(path);
    }
  return {"", to_string(place.kind), path};
}

plugin::PluginError blame(const std::exception& e, const Setup& setup, const model::CallSite& site,
                          const scene::Value& root, plugin::Registry& registry, double t, long long step) {
  const std::string cause = fmt::format("it threw: {}", e.what());
  if (site.component) return plugin::PluginError(origin_of(site, root, registry), site.call, cause, t).in_step(step);
  return plugin::PluginError(setup.integrator_origin, "step", cause, t).in_step(step);
}

}  // namespace trammel::simulate
