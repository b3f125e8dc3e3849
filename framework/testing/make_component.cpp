// Components from plugins, for tests. Plugins of a folder are looked up once in a process.
#include <map>
#include <mutex>

#include <trammel/testing/components.hpp>

#include "plugin/parameters.hpp"
#include "testing/plugin_folder.hpp"

namespace trammel {

plugin::Registry& plugin_folder(const std::string& folder) {
  static std::mutex mutex;
  static std::map<std::string, plugin::Registry> known;
  const std::lock_guard lock(mutex);
  const auto [at, is_new] = known.try_emplace(folder, plugin::Registry::Start::empty);
  if (is_new) at->second.search(folder);
  return at->second;
}

std::unique_ptr<Component> make_component(const std::string& folder, Kind kind, const std::string& entry,
                                          const World& world) {
  const scene::Scene scene = scene::Scene::parse(entry, "test.json");
  scene::Problems problems;
  auto made = plugin::make<Component>(plugin_folder(folder), kind, scene.root(), world, problems);
  problems.throw_if_any();
  return std::move(made.component);
}

}  // namespace trammel
