// All checks of a component, by its kind and by the interface that it implements.
#pragma once

#include <string>

#include "testing/kit/check.hpp"

namespace trammel::kit {

// "integrator", "body", "joint", "force", "contact force", "restitution", "smooth friction", "set-valued friction",
// "correction"; "" if it derives from no interface of its kind.
std::string interface_of(const Component& component);
Checks catalogue(const std::string& interface);

}  // namespace trammel::kit
