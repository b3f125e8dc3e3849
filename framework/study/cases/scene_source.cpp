#include "study/cases/scene_source.hpp"

#include "scene/files.hpp"

namespace trammel::study {

SceneSource::SceneSource(std::string file, std::vector<scene::Override> base)
    : file_(std::move(file)), text_(scene::read_file(file_)), base_(std::move(base)) {}

scene::Scene SceneSource::with(const std::vector<scene::Override>& more) const {
  std::vector<scene::Override> all = base_;
  all.insert(all.end(), more.begin(), more.end());
  return scene::Scene::parse(text_, file_, all);
}

}  // namespace trammel::study
