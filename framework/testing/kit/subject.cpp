#include "testing/kit/subject.hpp"

#include "plugin/parameters.hpp"

namespace trammel::kit {

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::unique_ptr<Component> make_from(const plugin::Entry& entry, const std::string& object, const World& world) {
  const scene::Scene scene = scene::Scene::parse(object, "check.json");
  scene::Problems problems;
  auto made = plugin::make<Component>(entry, scene.root(), world, problems);
  problems.throw_if_any();
  return std::move(made.component);
}

std::unique_ptr<Component> Subject::make() const {
  return make_from(entry, form.entry, form.world);
}

World world_of(Space space) {
  World world;
  world.space = space;
  world.gravity = Vec3::Zero(dimension(space));
  world.gravity(dimension(space) - 1) = -9.81;
  return world;
}

}  // namespace trammel::kit
