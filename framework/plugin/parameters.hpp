// Makes components from declarations and objects of the scene; checks keys, types and ranges.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include <trammel/parameters.hpp>

#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::plugin {

// Keys of a component's object that the framework reads itself, "type" first; used for reading, manual and schema.
struct FrameworkKey {
  std::string name, doc;
};
std::span<const FrameworkKey> framework_keys(Kind kind);

// Makes the component, sets its parameters from `object` and calls `prepare`. Adds all problems (unknown keys with the
// nearest name, types, ranges, missing values, parameters that `prepare` refuses) to `problems` and then returns
// nullptr. Throws PluginError if the component's constructor or `prepare` throws anything else.
std::unique_ptr<Component> make(const Entry& entry, const scene::Value& object,
                                std::span<const FrameworkKey> framework_keys, const World& world,
                                scene::Problems& problems);

// True if a number is in the declared range; otherwise reports a problem. Outside the usual range it reports a warning.
bool in_range(const scene::Value& value, double x, const Parameter& declared, scene::Problems& problems);

// Reports a ParameterError at the parameter's value or, if it is missing, at the object that should contain it.
scene::Problem refused(const scene::Value& object, const ParameterError& e);

// A component of interface T and its origin.
template <class T>
struct Made {
  std::unique_ptr<T> component;  // null: a problem was reported
  Origin origin;
};

[[noreturn]] void throw_wrong_interface(const Entry& entry);

// Makes the component that an object names by its "type":  make<Body>(registry, Kind::body, object, world, problems).
template <class T>
Made<T> make(Registry& registry, Kind kind, const scene::Value& object, const World& world, scene::Problems& problems);

// The same with an explicit `type`, which `object` need not contain ("corrections": {"position": "minimum_norm"}).
template <class T>
Made<T> make(const Entry& entry, const scene::Value& object, const World& world, scene::Problems& problems) {
  Made<T> made{nullptr, entry.origin(object.path())};
  std::unique_ptr<Component> component = make(entry, object, framework_keys(entry.declaration.kind), world, problems);
  if (!component) return made;
  T* as_interface = dynamic_cast<T*>(component.get());
  if (!as_interface) throw_wrong_interface(entry);
  component.release();
  made.component.reset(as_interface);
  return made;
}

// The entry that `object` names by its "type"; nullptr: a problem was reported.
const Entry* entry_of(Registry& registry, Kind kind, const scene::Value& object, scene::Problems& problems);

template <class T>
Made<T> make(Registry& registry, Kind kind, const scene::Value& object, const World& world, scene::Problems& problems) {
  const Entry* entry = entry_of(registry, kind, object, problems);
  return entry ? make<T>(*entry, object, world, problems) : Made<T>{nullptr, {"", to_string(kind), object.path()}};
}

}  // namespace trammel::plugin
