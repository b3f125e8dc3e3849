// The installed components that can do what one of them cannot, for messages.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "plugin/describe.hpp"
#include "plugin/registry.hpp"

namespace trammel::compatibility {

// Names of components of a kind, with every parameter at its default, that `can`: "a, b, c", or "none found".
std::string names_that(plugin::Registry& registry, Kind kind, const std::function<bool(const Component&)>& can);

// The same for an interface T:  names_that<Integrator>(registry, [](const Integrator& one) { ... });
template <class T, class Can>
std::string names_that(plugin::Registry& registry, Kind kind, Can can) {
  return names_that(registry, kind, [&](const Component& one) {
    const auto* as_interface = dynamic_cast<const T*>(&one);
    return as_interface && can(*as_interface);
  });
}

}  // namespace trammel::compatibility
