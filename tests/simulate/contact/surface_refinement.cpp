// A plate that refines for each of its reasons while a ball or another plate presses on it; cut and resumed anywhere.
#include <cmath>

#include "support/run_in_pieces.hpp"
#include "support/scenes.hpp"
#include "sheets.hpp"

namespace trammel::test {
namespace {

// The ball falls 0.2 mm and touches after some 2 ms.
std::string struck(const std::string& refine) {
  return R"({
  "trammel": 1, "space": "spatial", "gravity": [0, 0, -10],
  "bodies": {
    "plate": {"type": "tspline_plate", "geometry": {"shape": "rectangle", "along_u": [1, 0, 0], "along_v": [0, 1, 0]},
              "mesh": {"elements": "4x4"}, "thickness": 0.02, "density": 1000, "youngs_modulus": 1e8, "poissons_ratio": 0.3,
              "edges": {"u0": "clamped", "u1": "clamped", "v0": "clamped", "v1": "hinged"}, "refine": )" +
         refine + R"(},
    "ball": {"type": "point_mass", "mass": 3, "position": [0.3, 0.4, 0.1102], "velocity": [0, 0, -0.1]}},
  "contacts": {"ball": {"type": "penalty", "between": ["ball.com", {"surface": "plate"}], "radius": 0.1, "stiffness": 1e7}},
  "integrator": {"type": "generalized_alpha", "rho_inf": 0.8, "step": 1e-3},
  "simulate": {"until": 0.03},
  "record": {"every": 0.002, "fields": [0.004, 0.0125, 0.03],
             "observe": {"z": "ball.com.z", "centre": "plate.centre.z", "elements": "plate.elements"}}
})";
}

struct Trigger {
  std::string name, refine;
  std::size_t refinements;  // at least
};
std::ostream& operator<<(std::ostream& out, const Trigger& trigger) {
  return out << trigger.name;
}

class Resumed : public testing::TestWithParam<Trigger> {};

// Cuts lie before, between and after the refinements.
TEST_P(Resumed, RunEndsWithTheSameBytes) {
  const auto scene = scene::Scene::parse(struck(GetParam().refine), "test.json");
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 3);
  std::size_t refinements = 0;
  for (auto at = whole.events.find(",refine,"); at != std::string::npos; at = whole.events.find(",refine,", at + 1))
    ++refinements;
  EXPECT_GE(refinements, GetParam().refinements);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
  EXPECT_EQ(whole.fields, pieces.fields);
  EXPECT_FALSE(whole.fields.empty());
  EXPECT_EQ(nlohmann::json::diff(whole.data, pieces.data).dump(), "[]");
}

INSTANTIATE_TEST_SUITE_P(
    ByEachTrigger, Resumed,
    testing::Values(Trigger{"at", R"({"at": 0.0155, "elements": [5, 6]})", 1},
                    Trigger{"on_contact", R"({"on_contact": "ball", "elements": [5]})", 1},
                    Trigger{"near", R"({"on_contact": "ball", "near": 0.02, "levels": 2})", 1},
                    Trigger{"energy_density", R"({"indicator": "energy_density", "threshold": 0.3, "levels": 2})", 2},
                    Trigger{"curvature_jump", R"({"indicator": "curvature_jump", "threshold": 0.06, "levels": 2})", 2},
                    Trigger{"contact_pressure", R"({"indicator": "contact_pressure", "threshold": 4e3, "levels": 2})",
                            2}),
    [](const auto& trigger) { return trigger.param.name; });

constexpr double ball_after_1_ms = 0.109195039064;  // by dop853

class UnderEach : public testing::TestWithParam<Method> {};

// Refined when it is touched; methods of fourth order agree on z to 1e-12, those of second order are 5e-11 off.
TEST_P(UnderEach, IntegratorARefinedPlateMovesAlikeAndIsResumedToTheSameBytes) {
  const std::string text = struck(R"({"on_contact": "ball", "near": 0.02}, "quadrature": 4)");
  const Overrides short_run = {{"integrator", GetParam().json},
                               {"bodies.ball.velocity", "[0, 0, -1]"},
                               {"record.fields", "0.001"},
                               {"simulate.until", "0.001"}};
  const Finished run = run_text(text, short_run);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.of_kind("refine").size(), 1u);
  EXPECT_NEAR(run.end("z"), ball_after_1_ms, 1e-9);
  const auto scene = scene::Scene::parse(text, "test.json", short_run);
  const Logs whole = run_in_pieces(scene, 1LL << 60), pieces = run_in_pieces(scene, 7);
  EXPECT_EQ(whole.series, pieces.series);
  EXPECT_EQ(whole.events, pieces.events);
}

INSTANTIATE_TEST_SUITE_P(Of, UnderEach, testing::ValuesIn(fixed_methods("2e-5")), method_name);

std::string pressed(const std::string& threshold) {
  return struck(R"({"indicator": "contact_pressure", "threshold": )" + threshold + "}");
}

TEST(ContactPressure, RefinesWhereItIsAboveTheThreshold) {
  const Finished run = run_text(pressed("4e3"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  ASSERT_FALSE(run.of_kind("refine").empty());
  EXPECT_GE(run.of_kind("refine")[0].t, run.of_kind("contact_close")[0].t);
  EXPECT_GT(run.end("elements"), 16);
  EXPECT_LT(run.end("elements"), 64);  // not everywhere
}

TEST(ContactPressure, LeavesTheMeshBelowTheThreshold) {
  const Finished run = run_text(pressed("1e9"));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_EQ(run.end("elements"), 16);
}

// Two sheets of 9 elements each that strike each other.
Finished strike(const std::string& lower, const std::string& upper, double until) {
  return run_text(
      sheets(
          R"("lower": )" + lower + R"(, "upper": )" + upper,
          R"("pair": {"type": "penalty", "stiffness": 1e7, "spacing": 0.1, "between": [{"surface": "upper"}, {"surface": "lower"}]})",
          R"("lower": "lower.elements", "upper": "upper.elements")", until, "[0, 0, 0]"),
      {{"integrator.step", "5e-4"}, {"record.every", "1e-3"}});
}

// The lower sheet learns of the pressure though the upper one's points are asked; a third of it lies under the upper
// one.
TEST(ContactPressure, IsPassedToBothOfTwoSurfaces) {
  const std::string refine = R"(, "refine": {"indicator": "contact_pressure", "threshold": 1e3})";
  const Finished run =
      strike(sheet("[0, 0, 0]", refine), sheet("[0.65, 0.05, 0.0201]", R"(, "velocity": [0, 0, -0.2])"), 0.003);
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_GT(run.end("lower"), 9);
  EXPECT_LT(run.end("lower"), 36);  // the part that is struck
  EXPECT_EQ(run.end("upper"), 9);
}

TEST(RefineNear, FindsThePlaceOnEachOfTwoSurfaces) {
  const std::string refine = R"(, "refine": {"on_contact": "pair", "near": 0.01})";
  // The upper sheet comes down with a corner, on the lower one's far quarter.
  const Finished run = strike(
      sheet("[0, 0, 0]", refine),
      sheet("[0.6, 0.5, 0.021]", refine + R"(, "velocity": [0, 0, -0.5], "angular_velocity": [2, -2, 0])"), 0.01);
  ASSERT_TRUE(run.done()) << run.report.reason;
  for (const char* plate : {"lower", "upper"}) {
    EXPECT_GT(run.end(plate), 9) << plate;
    EXPECT_LT(run.end(plate), 36) << plate;
  }
}

}  // namespace
}  // namespace trammel::test
