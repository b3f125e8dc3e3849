#include "testing/kit/catalogue.hpp"

#include <map>

#include <trammel/correction.hpp>
#include <trammel/friction.hpp>

#include "testing/kit/components/common.hpp"
#include "testing/kit/components/components.hpp"
#include "testing/kit/integrators/integrators.hpp"

namespace trammel::kit {

namespace {

template <class T>
bool is(const Component& c) {
  return dynamic_cast<const T*>(&c) != nullptr;
}

struct Interface {
  const char* name;
  bool (*is)(const Component&);
  Checks (*checks)();
};

constexpr Interface interfaces[] = {
    {"integrator", is<Integrator>, integrator_checks},
    {"body", is<Body>, body_checks},
    {"joint", is<Constraint>, joint_checks},
    {"force", is<Force>, force_checks},
    {"contact force", is<ContactForce>, contact_force_checks},
    {"restitution", is<Restitution>, restitution_checks},
    {"smooth friction", is<SmoothFriction>, smooth_friction_checks},
    {"set-valued friction", is<SetValuedFriction>, set_valued_friction_checks},
    {"correction", is<Correction>, correction_checks},
};

}  // namespace

std::string interface_of(const Component& component) {
  for (const Interface& one : interfaces)
    if (one.is(component)) return one.name;
  return "";
}

Checks catalogue(const std::string& interface) {
  Checks all = parameter_checks();
  for (const Interface& one : interfaces)
    if (interface == one.name)
      for (Check& check : one.checks()) all.push_back(std::move(check));
  for (Check& check : process_checks()) all.push_back(std::move(check));
  return all;
}

}  // namespace trammel::kit
