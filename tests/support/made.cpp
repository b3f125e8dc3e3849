#include "support/made.hpp"

namespace trammel::test {

World planar() {
  return {Space::planar, Eigen::Vector2d(0, -9.81)};
}

World spatial() {
  return {Space::spatial, Eigen::Vector3d(0, 0, -9.81)};
}

plugin::Registry& registry() {
  static plugin::Registry built = [] {
    plugin::Registry r(plugin::Registry::Start::empty);
    r.search(TRAMMEL_BUILD_DIR "/lib/trammel");
    r.allow_scene_plugins();  // the scenes are ours
    return r;
  }();
  return built;
}

std::string refusal(Kind kind, const std::string& entry, const World& world) {
  try {
    made<Component>(kind, entry, world);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace trammel::test
