// A registry that knows only what a test loads, and scenes in memory.
#pragma once

#include <string>

#include "plugin/registry.hpp"

namespace trammel::plugin {

inline Registry empty_registry() {
  return Registry(Registry::Start::empty);
}

inline scene::Value scene_of(const std::string& text) {
  return scene::Scene::parse(text, "scene.json").root();
}

}  // namespace trammel::plugin
