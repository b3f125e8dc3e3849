// What a check is asked about: one component of one library, in one form of its parameters.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include <trammel/parameters.hpp>
#include <trammel/testing/components.hpp>

#include "plugin/registry.hpp"
#include "testing/kit/check.hpp"

namespace trammel::kit {

// Parameters as in a scene, and the world they are for.
struct Form {
  std::string name;   // "planar", "spatial", "formulation index3": for messages; "" if there is only one
  std::string entry;  // a JSON object: {"type": "newmark"}
  World world;
};

struct Subject {
  const plugin::Entry& entry;
  Form form;
  Level level = Level::quick;
  unsigned seed = 1;

  const Declaration& declaration() const { return entry.declaration; }
  // A fresh component, prepared as in a run. Throws scene::SceneError if the parameters are refused.
  std::unique_ptr<Component> make() const;
  template <class T>
  MakerOf<T> maker() const {
    return [subject = *this] { return subject.as<T>(subject.make()); };
  }
  template <class T>
  bool offers() const {
    return dynamic_cast<const T*>(make().get()) != nullptr;
  }
  Traits traits() const { return maker<Integrator>()()->traits(); }

  // The same numbers for the same seed, other ones for each purpose.
  std::mt19937 random(unsigned purpose = 0) const { return std::mt19937(seed * 7919 + purpose); }

  template <class T>
  static std::unique_ptr<T> as(std::unique_ptr<Component> component) {
    T& interface = dynamic_cast<T&>(*component);
    component.release();
    return std::unique_ptr<T>(&interface);
  }
};

double between(std::mt19937& random, double low, double high);

// A component made from its entry as a run makes it; throws scene::SceneError, or what the component throws.
std::unique_ptr<Component> make_from(const plugin::Entry& entry, const std::string& object, const World& world);

World world_of(Space space);  // gravity 9.81 m/s^2 along -y in the plane, -z in space

}  // namespace trammel::kit
