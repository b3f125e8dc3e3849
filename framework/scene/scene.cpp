#include "scene/builder.hpp"
#include "scene/files.hpp"

namespace trammel::scene {

Scene::Scene(const std::string& text, const std::string& file, const std::vector<Override>& overrides)
    : root_(resolve_includes(parse_text(text, file), file)), file_(file), overrides_(overrides) {
  for (const Override& override : overrides) apply(override, root_);
  // Parameters first: every other value may use them.
  Builder::finish(root_, "", nullptr);
  const auto parameters = evaluate_parameters(root_);
  Builder::finish(root_, "", parameters);
  warnings_ = set_in_vain(root_, overrides);
  if (repeats_units(root_)) before_repetition_ = root_;
  repeat_units(root_, *parameters);
  Builder::finish(root_, "", parameters);
  hash_ = Builder::hash(root_);
}

Scene Scene::load(const std::string& file, const std::vector<Override>& overrides) {
  return Scene(read_file(file), file, overrides);
}

Scene Scene::parse(const std::string& text, const std::string& name, const std::vector<Override>& overrides) {
  return Scene(text, name, overrides);
}

std::string Scene::resolved() const {
  return written(before_repetition_ ? *before_repetition_ : root_);
}

}  // namespace trammel::scene
