// Which laws of time a scene has.
#include "simulate/start/laws_of_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/made.hpp"

namespace trammel::test {
namespace {

std::vector<scene::LawOfTime> laws_of(const std::string& text) {
  const scene::Scene scene = scene::Scene::parse(text, "test.json");
  return simulate::laws_of_scene(scene.root(), registry());
}

bool has(const std::vector<scene::LawOfTime>& laws, const std::string& text, int derivatives, bool is_angle) {
  return std::any_of(laws.begin(), laws.end(), [&](const scene::LawOfTime& law) {
    return law.law.text() == text && law.derivatives == derivatives && law.is_angle == is_angle;
  });
}

TEST(LawsOfAScene, AreThoseOfAllComponentsAndTheirParts) {
  const auto laws = laws_of(R"json({"trammel": 1, "space": "spatial",
    "bodies": {"base": {"type": "moving_base", "x": "=sin(t)", "y": "=1+2", "angle": "=3*t"},
               "sheet": {"type": "tspline_plate", "patches": {
                   "one": {"edge_moment": {"u0": "=t"}}, "two": {"edge_moment": {"v1": "=2*t", "v0": 5}}}}},
    "joints": {"rod": {"type": "distance", "length": "=2+t"}},
    "forces": {"hand": {"type": "load", "on": "ground", "force": {"x": "=t^2", "z": 7}}},
    "contacts": {"latch": {"type": "latch", "reaches": {"type": "distance", "length": "=4+t"}}}})json");
  EXPECT_TRUE(has(laws, "sin(t)", 2, false));
  EXPECT_TRUE(has(laws, "3*t", 2, true));
  EXPECT_TRUE(has(laws, "t", 0, false));
  EXPECT_TRUE(has(laws, "2*t", 0, false));
  EXPECT_TRUE(has(laws, "2+t", 2, false));
  EXPECT_TRUE(has(laws, "t^2", 0, false));
  EXPECT_TRUE(has(laws, "4+t", 2, false));
  EXPECT_EQ(laws.size(), 7U);
}

TEST(LawsOfAScene, AreEachThereOnceAndNeverConstant) {
  const auto laws = laws_of(R"json({"trammel": 1, "space": "planar",
    "bodies": {"b": {"type": "point_mass", "mass": 1}},
    "forces": {"one": {"type": "load", "on": "b.point", "force": {"x": "=sin(2*t)", "y": "=sin(2)"}},
               "two": {"type": "load", "on": "b.point", "force": {"x": "=sin(2*t)"}}}})json");
  EXPECT_EQ(laws.size(), 1U);
}

}  // namespace
}  // namespace trammel::test
