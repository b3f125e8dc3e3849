// Every scene of the repository is valid.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "scene/value.hpp"
#include "simulate/simulation.hpp"

#include "../plugins/made.hpp"

namespace trammel::test {
namespace {

const std::filesystem::path kScenes = TRAMMEL_SOURCE_DIR "/scenes";

std::vector<std::string> all_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes))
    if (entry.path().extension() == ".json") names.push_back(entry.path().lexically_relative(kScenes).string());
  std::sort(names.begin(), names.end());
  return names;
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, IsValidWithoutWarnings) {
  EXPECT_NO_THROW(EXPECT_EQ(simulate::validate(scene::Scene::load(kScenes / GetParam()), registry()), ""));
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(all_scenes()), [](const auto& scene) {
  std::string name = scene.param.substr(0, scene.param.size() - 5);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace trammel::test
