// A scene that is run many times with different values: its text is read once.
#pragma once

#include <string>
#include <vector>

#include "scene/value.hpp"

namespace trammel::study {

class SceneSource {
 public:
  // Reads the file. `base`: overrides of every case. Throws SceneError.
  explicit SceneSource(std::string file, std::vector<scene::Override> base = {});

  // The scene with `more` applied after the base; equal to what `trammel run --set` reads. Throws SceneError.
  scene::Scene with(const std::vector<scene::Override>& more = {}) const;
  const std::string& file() const { return file_; }
  const std::vector<scene::Override>& base() const { return base_; }

 private:
  std::string file_, text_;
  std::vector<scene::Override> base_;
};

}  // namespace trammel::study
