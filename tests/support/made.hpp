// Components for tests, made as a run makes them: from the text of their entry in a scene, through the registry.
#pragma once

#include <memory>
#include <string>

#include "plugin/parameters.hpp"
#include "plugin/registry.hpp"

namespace trammel::test {

inline World planar() {
  return {Space::planar, Eigen::Vector2d(0, -9.81)};
}
inline World spatial() {
  return {Space::spatial, Eigen::Vector3d(0, 0, -9.81)};
}

inline plugin::Registry& registry() {
  static plugin::Registry built = [] {
    plugin::Registry r(plugin::Registry::Start::empty);
    r.search(TRAMMEL_BUILD_DIR "/lib/trammel");
    r.allow_scene_plugins();  // the scenes are ours
    return r;
  }();
  return built;
}

// Throws scene::SceneError with every problem if the entry is refused.
template <class T>
std::unique_ptr<T> made(Kind kind, const std::string& entry, const World& world = planar()) {
  const scene::Scene scene = scene::Scene::parse(entry, "test.json");
  scene::Problems problems;
  auto result = plugin::make<T>(registry(), kind, scene.root(), world, problems);
  problems.throw_if_any();
  return std::move(result.component);
}

// What the user reads when the entry is refused; empty: it was accepted.
inline std::string refusal(Kind kind, const std::string& entry, const World& world = planar()) {
  try {
    made<Component>(kind, entry, world);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace trammel::test
