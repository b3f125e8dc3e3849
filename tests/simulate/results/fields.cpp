// fields.ndjson: what a body shows over its elements, at the times that the scene names.
#include <gmock/gmock.h>

#include "statics/static_run.hpp"
#include "support/run_scene.hpp"
#include "support/scenes.hpp"

namespace trammel::test {
namespace {

using testing::ElementsAre;

// A strip of 1 m x 0.2 m x 10 mm without Poisson's effect, bent by an edge moment of t N m/m.
const std::string strip = R"({
  "trammel": 1, "space": "spatial", "gravity": [0, 0, 0],
  "bodies": {"strip": {"type": "tspline_plate", "geometry": {"shape": "rectangle", "along_u": [1, 0, 0], "along_v": [0, 0.2, 0]},
    "mesh": {"elements": "4x1"}, "thickness": 0.01, "density": 1000, "youngs_modulus": 1e9, "poissons_ratio": 0,
    "quadrature": 4, "edges": {"u0": "clamped"}, "edge_moment": {"u1": "=t"}}},
  "static": {"steps": 4},
  "record": {"every": 0.01}
})";

std::vector<nlohmann::json> fields_of(const scene::Scene& scene, Runner run) {
  const Folder folder;
  simulate::RunOptions options;
  options.out = folder.path();
  const simulate::RunReport report = run(scene, registry(), options);
  EXPECT_EQ(report.status, simulate::Status::done) << report.reason;
  std::vector<nlohmann::json> lines;
  for (const std::string& line : split(read_text(folder.path() / "fields.ndjson"), '\n'))
    lines.push_back(nlohmann::json::parse(line));
  return lines;
}

std::vector<double> times_of(const std::vector<nlohmann::json>& lines) {
  std::vector<double> times;
  for (const auto& line : lines) times.push_back(line["t"]);
  return times;
}

scene::Scene in_motion(Overrides more) {
  more.push_back({"integrator", R"({"type": "generalized_alpha", "rho_inf": 0.8, "step": 1e-3})"});
  more.push_back({"simulate.until", "0.06"});
  return scene::Scene::parse(strip, "test.json", more);
}

// Pure bending: sigma = 6 M/h^2 at both faces, everywhere. The strip's stretch is sigma^2/E^2 of that.
TEST(Fields, OfABentStripAreItsStressAllOver) {
  const auto lines =
      fields_of(scene::Scene::parse(strip, "test.json", {{"record.fields", "[0.5, 1]"}}), simulate::run_static);
  ASSERT_THAT(times_of(lines), ElementsAre(0.5, 1));
  for (const auto& line : lines) {
    const auto& shown = line["bodies"]["strip"];
    EXPECT_EQ(shown["fields"].dump(), R"(["von_mises_top","von_mises_middle","von_mises_bottom"])");
    ASSERT_EQ(shown["patches"].size(), 4u);
    const double stress = 6 * double(line["t"]) / (0.01 * 0.01);
    for (const auto& patch : shown["patches"])
      for (std::size_t k = 0; k < patch["points"].size(); ++k) {
        EXPECT_NEAR(double(patch["values"][0][k]) / stress, 1, 2e-4);
        EXPECT_NEAR(double(patch["values"][1][k]) / stress, 0, 2e-4);
        EXPECT_NEAR(double(patch["values"][2][k]) / stress, 1, 2e-4);
      }
  }
}

// The strip in two patches, the second turned, so that its elements are counted from the other end.
const std::string two_patches = R"({"type": "tspline_plate",
    "patches": {
      "held": {"geometry": {"along_u": [0.5, 0, 0], "along_v": [0, 0.2, 0]}, "mesh": {"elements": "2x1"},
               "edges": {"u0": "clamped"}},
      "turned": {"geometry": {"origin": [1, 0.2, 0], "along_u": [-0.5, 0, 0], "along_v": [0, -0.2, 0]},
                 "mesh": {"elements": "2x1"}, "edge_moment": {"u0": "=t"}}},
    "joined": {"joint": {"from": "held.u1", "to": "turned.u1", "continuity": "C1"}},
    "thickness": 0.01, "density": 1000, "youngs_modulus": 1e9, "poissons_ratio": 0, "quadrature": 4})";

TEST(Fields, OfTwoPatchesAreTheirStressAllOver) {
  const auto lines =
      fields_of(scene::Scene::parse(strip, "test.json", {{"bodies.strip", two_patches}, {"record.fields", "[0.5, 1]"}}),
                simulate::run_static);
  ASSERT_THAT(times_of(lines), ElementsAre(0.5, 1));
  for (const auto& line : lines) {
    const auto& patches = line["bodies"]["strip"]["patches"];
    ASSERT_EQ(patches.size(), 4u);
    const double stress = 6 * double(line["t"]) / (0.01 * 0.01);
    for (const auto& patch : patches)
      for (const double value : patch["values"][0]) EXPECT_NEAR(value / stress, 1, 2e-4);
    // Both sides meet at the joint: the last points of the second element, the first ones of the fourth.
    const auto &here = patches[1]["points"], &there = patches[3]["points"];
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(double(here[5 * k + 4][axis]), double(there[5 * (4 - k) + 4][axis]), 1e-8);
  }
}

TEST(Fields, OfTwoPatchesShowTheElementsThatThereAreInEach) {
  const auto lines = fields_of(in_motion({{"bodies.strip", two_patches},
                                          {"record.fields", "[0.03, 0.04]"},
                                          {"bodies.strip.patches.turned.mesh.closure", "\"none\""},
                                          {"bodies.strip.refine", R"({"at": 0.035, "elements": [2]})"}}),
                               simulate::run);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["bodies"]["strip"]["patches"].size(), 4u);
  EXPECT_EQ(lines[1]["bodies"]["strip"]["patches"].size(), 7u);
}

TEST(Fields, AreWrittenWithTheFirstRowAtOrAfterEachTime) {
  const auto lines = fields_of(in_motion({{"record.fields", "[0.05, 0, 0.013, 0.015]"}}), simulate::run);
  EXPECT_THAT(times_of(lines), ElementsAre(0, 0.02, 0.05));  // 0.013 and 0.015 share one
}

TEST(Fields, ShowTheElementsThatThereAreAtTheirTime) {
  const auto lines = fields_of(in_motion({{"record.fields", "[0.03, 0.04]"},
                                          {"bodies.strip.refine", R"({"at": 0.035, "elements": [3]})"},
                                          {"bodies.strip.mesh.closure", "none"}}),
                               simulate::run);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["bodies"]["strip"]["patches"].size(), 4u);
  EXPECT_EQ(lines[1]["bodies"]["strip"]["patches"].size(), 7u);
}

std::string refusal(const std::string& text, const Overrides& overrides) {
  try {
    run_text(text, overrides);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Fields, OfASceneWithoutThemAreRefusedWithTheBodiesThatHaveThem) {
  EXPECT_THAT(
      refusal(ball, {{"record.fields", "[0.1]"}}),
      testing::AllOf(testing::HasSubstr("no body of this scene has fields"), testing::HasSubstr("tspline_plate")));
}

TEST(Fields, OutsideTheRunAreRefused) {
  EXPECT_THAT(refusal(strip, {{"integrator", R"({"type": "generalized_alpha", "step": 1e-3})"},
                              {"simulate.until", "0.06"},
                              {"record.fields", "0.07"}}),
              testing::HasSubstr("found 0.07, expected times from 0 to 0.06 [s]"));
}

}  // namespace
}  // namespace trammel::test
