#include "scene/builder.hpp"

namespace trammel::scene {

namespace {

// Parameters first: their values decide nothing about the tree, but every other value may use them.
Value finish(Value root, const std::vector<Override>& overrides) {
  for (const Override& override : overrides) apply(override, root);
  Builder::finish(root, "", nullptr);
  const auto parameters = evaluate_parameters(root);
  Builder::finish(root, "", parameters);
  return root;
}

}  // namespace

Scene Scene::load(const std::string& file, const std::vector<Override>& overrides) {
  Scene scene;
  scene.file_ = file;
  scene.root_ = finish(resolve_includes(parse_text(read_file(file), file), file), overrides);
  scene.hash_ = Builder::hash(scene.root_);
  return scene;
}

Scene Scene::parse(const std::string& text, const std::string& name, const std::vector<Override>& overrides) {
  Scene scene;
  scene.file_ = name;
  scene.root_ = finish(resolve_includes(parse_text(text, name), name), overrides);
  scene.hash_ = Builder::hash(scene.root_);
  return scene;
}

}  // namespace trammel::scene
