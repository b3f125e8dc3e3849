// Every scene and every study of the repository is valid.
#include <algorithm>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "commands/simulation.hpp"
#include "scene/value.hpp"
#include "simulate/start/setup.hpp"
#include "study/study_file.hpp"

#include "support/made.hpp"

namespace trammel::test {
namespace {

const std::filesystem::path kScenes = TRAMMEL_SOURCE_DIR "/scenes";

std::vector<std::string> files(bool studies) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes))
    if (entry.path().extension() == ".json" && (entry.path().parent_path().filename() == "studies") == studies)
      names.push_back(entry.path().lexically_relative(kScenes).string());
  std::sort(names.begin(), names.end());
  return names;
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, IsValidWithoutWarnings) {
  EXPECT_NO_THROW(EXPECT_EQ(simulate::validate(scene::Scene::load(kScenes / GetParam()), registry()), ""));
}

// As one file it means the same, and resolves to itself. Tables' names become absolute, which changes the hash.
TEST_P(EveryScene, IsResolvedToOneFileThatMeansTheSame) {
  const scene::Scene scene = scene::Scene::load(kScenes / GetParam());
  const scene::Scene again = scene::Scene::parse(scene.resolved(), "resolved.json");
  EXPECT_EQ(again.resolved(), scene.resolved());
  if (scene.resolved().find("\"table\"") == std::string::npos) {
    EXPECT_EQ(again.hash(), scene.hash());
  }
}

std::set<std::string> words(const std::string& text) {
  std::set<std::string> all;
  const auto part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (auto begin = text.begin(); (begin = std::find_if(begin, text.end(), part)) != text.end();) {
    const auto end = std::find_if_not(begin, text.end(), part);
    all.emplace(begin, end);
    begin = end;
  }
  return all;
}

// As a manual page writes it: "transverse_3" is one of "transverse_1 ...", "von_mises_top_tip" one of
// "von_mises_top_MARKER".
std::string as_declared(std::string name, const std::vector<std::string>& markers) {
  for (const std::string& marker : markers)
    if (name.ends_with("_" + marker)) name.replace(name.size() - marker.size(), marker.size(), "MARKER");
  const std::size_t digits = name.find_last_not_of("0123456789") + 1;
  if (digits < name.size() && digits > 0 && name[digits - 1] == '_') name.replace(digits, name.npos, "1");
  return name;
}

TEST_P(EveryScene, HasBodiesWithTheMarkersAndObservablesThatTheirManualNames) {
  const scene::Scene scene = scene::Scene::load(kScenes / GetParam());
  const simulate::Setup setup = simulate::set_up(scene, registry(), simulate::purpose_of(scene.root()));
  for (const model::BodyEntry& body : setup.model->bodies) {
    const scene::Value& entry = *scene.root().at_path("bodies." + body.name);
    const Declaration& declared = registry().find(Kind::body, entry.find("type")->text()).declaration;
    const auto known = words(declared.markers), observed = words(declared.observables);
    const auto given = entry.find("markers");
    const auto range = body.body->markers();
    const std::vector<std::string> markers(range.begin(), range.end());
    for (const std::string& name : markers) {
      const bool of_patch = known.contains("PATCH_centre") && entry.find("patches");
      EXPECT_TRUE(known.contains(name) || (given && given->find(name)) || of_patch) << body.name << "." << name;
    }
    if (!body.observed) continue;
    for (const std::string& name : body.observed->observables())
      EXPECT_TRUE(observed.contains(name) || observed.contains(as_declared(name, markers))) << body.name << "." << name;
  }
}

class EveryStudy : public testing::TestWithParam<std::string> {};

// Also with all values of a case together, which reading a study does not try.
TEST_P(EveryStudy, HasCasesThatAreValidScenes) {
  const study::Study study = study::Study::load((kScenes / GetParam()).string());
  for (std::size_t i = 0; i < study.size(); ++i) {
    const study::SceneSource source(study.scene_files()[study.scene_of(i)], study.set());
    EXPECT_NO_THROW(EXPECT_EQ(simulate::validate(source.with(study.overrides(i)), registry()), "")) << "case " << i;
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& file) {
  std::string name = file.param.substr(0, file.param.size() - 5);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(files(false)), test_name);
INSTANTIATE_TEST_SUITE_P(Scenes, EveryStudy, testing::ValuesIn(files(true)), test_name);

}  // namespace
}  // namespace trammel::test
