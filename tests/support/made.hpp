// Components for tests, made as a run makes them: from the text of their entry in a scene, through the registry.
#pragma once

#include <memory>
#include <string>

#include "plugin/parameters.hpp"
#include "plugin/registry.hpp"

namespace trammel::test {

World planar();
World spatial();

plugin::Registry& registry();

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
std::string refusal(Kind kind, const std::string& entry, const World& world = planar());

}  // namespace trammel::test
