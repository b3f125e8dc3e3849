// Feet of two hinged blocks, both below the hinge: their rows are the same until one block turns about the hinge. Then
// the gap of its foot accelerates by the distance from the hinge times the square of the angular velocity.
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "block.hpp"
#include "support/between.hpp"
#include "support/run_scene.hpp"

namespace trammel::test {
namespace {

using nlohmann::json;

constexpr double soon = 0.02;  // [s] the turn begins slowly

json foot(std::mt19937& random, const char* marker) {
  const double mu = between(random, 0.05, 0.5);
  return {{"type", "constraint_method"},
          {"restitution", 0},
          {"between", {marker, {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}}}},
          {"friction", {{"type", "coulomb"}, {"static", mu}, {"kinetic", mu}}}};
}

// The load on the left block grows until it lifts the foot in the middle.
json lifted_block(std::mt19937& random) {
  const double w = between(random, 0.3, 0.6), h = between(random, 0.1, 0.3);
  json s = {{"trammel", 1},
            {"space", "planar"},
            {"gravity", {0, -9.81}},
            {"bodies",
             {{"a", standing_block(0, w, h, between(random, 0.5, 2))},
              {"b", standing_block(w, between(random, 0.3, 0.6), h, between(random, 2, 5))}}},
            {"joints", {{"hinge", {{"type", "revolute"}, {"between", {"a.right", "b.left"}}}}}},
            {"simulate", {{"until", 0.4}}},
            {"record", {{"every", 0.05}, {"observe", {{"turn", "a.angle"}}}}}};
  s["bodies"]["a"]["markers"]["middle"] = {0, -h / 2};
  s["bodies"]["a"]["markers"]["pulled"] = {between(random, -0.4, 0.4) * w, between(random, -0.4, 0.4) * h};
  const double x = between(random, -60, 60), y = between(random, 40, 90);
  s["forces"]["pull"] = {{"type", "load"},
                         {"on", "a.pulled"},
                         {"force", {{"x", fmt::format("={}*t", x)}, {"y", fmt::format("={}*t", y)}}}};
  s["contacts"] = {{"middle", foot(random, "a.middle")},
                   {"below_hinge", foot(random, "a.br")},
                   {"other_below_hinge", foot(random, "b.bl")},
                   {"end", foot(random, "b.br")}};
  return s;
}

double first_opening(const Finished& run, const std::string& contact) {
  for (const Event& event : run.of_kind("contact_open"))
    if (event.contact == "contacts." + contact) return event.t;
  return INFINITY;
}

TEST(FeetBelowAHinge, OpenSoonAfterTheirBlockBeginsToTurn) {
  std::mt19937 random(5);
  int lifted = 0;
  for (int i = 0; i < 40; ++i) {
    const Finished run = run_text(lifted_block(random).dump());
    ASSERT_TRUE(run.done()) << i << ": " << run.report.reason;
    EXPECT_TRUE(run.result["warnings"].empty()) << i << ": " << run.result["warnings"].dump();
    EXPECT_LT(run.result["counts"]["steps"].get<int>(), 200) << i;
    const double middle = first_opening(run, "middle"), hinge = first_opening(run, "below_hinge");
    if (!std::isfinite(middle) || middle > 0.4 - soon) continue;
    EXPECT_LT(hinge, middle + soon) << i;
    ++lifted;
  }
  EXPECT_GT(lifted, 20);
}

}  // namespace
}  // namespace trammel::test
