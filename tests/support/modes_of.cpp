#include "support/modes_of.hpp"

namespace trammel::test {

Modes modes_of(const scene::Scene& scene, simulate::ModesOptions options) {
  const Folder folder;
  options.out = folder.path();
  const simulate::RunReport report = simulate::analyse_modes(scene, registry(), options);
  EXPECT_EQ(report.status, simulate::Status::done) << report.reason;
  EXPECT_EQ(report.result_json, read_text(folder.path() / "modes.json"));
  return {nlohmann::json::parse(report.result_json), read_text(folder.path() / "shapes.csv")};
}

Modes modes_of(const std::string& text, const Overrides& overrides, simulate::ModesOptions options) {
  return modes_of(scene::Scene::parse(text, "test.json", overrides), options);
}

Modes modes_of_file(const std::string& file, const Overrides& overrides, simulate::ModesOptions options) {
  return modes_of(scene::Scene::load(TRAMMEL_SOURCE_DIR "/scenes/" + file, overrides), options);
}

}  // namespace trammel::test
