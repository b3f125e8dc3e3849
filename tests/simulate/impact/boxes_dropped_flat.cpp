// Boxes on each other that fall flat on a floor: they move along the vertical only, so friction between them has no
// slip to oppose, and the rounded forces that balance across it move nothing.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

constexpr double height = 0.2, gap = 0.02;  // [m] of a box, below each box

std::string dropped(int boxes, double width, double mu) {
  std::string bodies, contacts, observe;
  for (int k = 0; k < boxes; ++k) {
    const char* comma = k == 0 ? "" : ", ";
    bodies += fmt::format(R"({}"b{}": {{"type": "rigid_body", "mass": 2, "inertia": {}, "position": [0, {}],
                              "markers": {{"left": [{}, {}], "right": [{}, {}], "top": [0, {}]}}}})",
                          comma, k, (width * width + height * height) / 6, (k + 0.5) * height + (k + 1) * gap,
                          -width / 2, -height / 2, width / 2, -height / 2, height / 2);
    for (const char* corner : {"left", "right"})
      contacts += fmt::format(R"({}"{}{}": {{"type": "constraint_method", "restitution": 0.4,
                                  "impact_law": "energetic",
                                  "friction": {{"type": "coulomb", "static": {}, "kinetic": {}}},
                                  "between": ["b{}.{}", {{"plane": {{"point": [0, 0], "normal": [0, 1]{}}}}}]}})",
                              contacts.empty() ? "" : ", ", corner, k, mu, mu, k, corner,
                              k == 0 ? "" : fmt::format(R"(, "on": "b{}.top")", k - 1));
    observe += fmt::format(R"({}"y{}": "b{}.com.y")", comma, k, k);
  }
  return fmt::format(R"({{"trammel": 1, "space": "planar", "gravity": [0, -9.81], "bodies": {{{}}},
      "contacts": {{{}}}, "simulate": {{"until": 0.4}}, "record": {{"every": 0.02, "observe": {{{}}}}}}})",
                     bodies, contacts, observe);
}

TEST(BoxesDroppedFlat, ReboundByTheEnergeticLawAsIfTheyHadNoFriction) {
  for (const int boxes : {2, 3, 4})
    for (const double width : {0.2, 0.8}) {
      const Finished smooth = run_text(dropped(boxes, width, 0));
      ASSERT_TRUE(smooth.done()) << smooth.report.reason;
      for (const double mu : {0.1, 0.3}) {
        const std::string which = fmt::format("{} boxes of {} m, mu = {}", boxes, width, mu);
        const Finished run = run_text(dropped(boxes, width, mu));
        ASSERT_TRUE(run.done()) << which << run.report.reason;
        EXPECT_TRUE(run.result["warnings"].empty()) << which << run.result["warnings"].dump();
        for (int k = 0; k < boxes; ++k) {
          const std::string y = fmt::format("y{}", k);
          for (std::size_t i = 0; i < smooth.series.at(y).size(); ++i)
            ASSERT_NEAR(run.series.at(y)[i], smooth.series.at(y)[i], 1e-8) << which << ", " << y << " at " << i;
        }
      }
    }
}

// A box in space that slides and spins as it lands on four feet: where its feet have hardly any slip left, the slips
// turn faster than the shortest step of the impact follows.
TEST(BoxDroppedFlat, ThatSlidesAndSpinsLosesEnergyAndTheRunGoesOn) {
  std::string contacts;
  for (const char* foot : {"a", "b", "c", "d"})
    contacts += fmt::format(R"({}"{}": {{"type": "constraint_method", "restitution": 0, "impact_law": "energetic",
                                "friction": {{"type": "coulomb", "static": 1, "kinetic": 1}},
                                "between": ["box.{}", {{"plane": {{"point": [0, 0, 0], "normal": [0, 0, 1]}}}}]}})",
                            contacts.empty() ? "" : ", ", foot, foot);
  const Finished run = run_text(fmt::format(R"({{"trammel": 1, "space": "spatial", "gravity": [0, 0, -9.81],
      "bodies": {{"box": {{"type": "rigid_body", "mass": 3.38, "inertia": [0.0412641667, 0.0102808333, 0.0420246667],
        "position": [0.4, 0.4, 0.085], "velocity": [-0.2, -3, -3.4], "angular_velocity": [0, 0, -0.4],
        "markers": {{"a": [-0.07, -0.18, -0.065], "b": [0.07, -0.18, -0.065],
                     "c": [0.07, 0.18, -0.065], "d": [-0.07, 0.18, -0.065]}}}}}},
      "contacts": {{{}}}, "simulate": {{"until": 0.02}}, "record": {{"every": 0.01}}}})",
                                            contacts));
  ASSERT_TRUE(run.done()) << run.report.reason;
  EXPECT_LT(run.end("energy_total"), run.series.at("energy_total").front());
}

}  // namespace
}  // namespace trammel::test
