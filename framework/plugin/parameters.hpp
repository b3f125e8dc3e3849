// From a declaration and an object of the scene to a component: every key known, every value of the right type and
// range.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include <trammel/parameters.hpp>

#include "plugin/registry.hpp"
#include "scene/value.hpp"

namespace trammel::plugin {

// Keys of a component's object that the framework reads itself, "type" first: what is read, and what manual and schema say.
struct FrameworkKey {
  std::string name, doc;
};
std::span<const FrameworkKey> framework_keys(Kind kind);

// Makes the component and sets its parameters from `object`, then lets it look at the world. Problems (unknown keys
// with the nearest name, types, ranges, missing values, what `prepare` refuses) go to `problems`, all of them at once;
// then nullptr is returned. Throws PluginError when the component's constructor or `prepare` throws anything else.
std::unique_ptr<Component> make(const Entry& entry, const scene::Value& object,
                                std::span<const FrameworkKey> framework_keys, const World& world,
                                scene::Problems& problems);

// What a component refuses, said at the value of the parameter or, where it is missing, at the object it would stand in.
scene::Problem refused(const scene::Value& object, const ParameterError& e);

// A component of interface T, and where it comes from.
template <class T>
struct Made {
  std::unique_ptr<T> component;  // null: reported to `problems`
  Origin origin;
};

[[noreturn]] void throw_wrong_interface(const Entry& entry);

// Makes the component that an object names by its "type":  make<Body>(registry, Kind::body, object, world, problems).
template <class T>
Made<T> make(Registry& registry, Kind kind, const scene::Value& object, const World& world, scene::Problems& problems);

// Likewise, the type given by `type`, which need not stand in `object` ("corrections": {"position": "minimum_norm"}).
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

// The entry that `object` names by its "type"; nullptr: reported to `problems`.
const Entry* entry_of(Registry& registry, Kind kind, const scene::Value& object, scene::Problems& problems);

template <class T>
Made<T> make(Registry& registry, Kind kind, const scene::Value& object, const World& world, scene::Problems& problems) {
  const Entry* entry = entry_of(registry, kind, object, problems);
  return entry ? make<T>(*entry, object, world, problems) : Made<T>{nullptr, {"", to_string(kind), object.path()}};
}

}  // namespace trammel::plugin
